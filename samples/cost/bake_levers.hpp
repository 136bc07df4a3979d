// The levers of the bake: the scene is baked once more for each choice of them.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lever.hpp"

namespace cost {

/// All of them, with the reason of those that can change nothing in this scene. Throws std::exception.
std::vector<Lever> bakeLevers(const std::string& sceneFile);

/// True where Whitted's tracer is what the scene asks for, and so the only integrator that is of use.
bool asksForWhitted(const std::string& sceneFile);

/// Bakes into a folder of its own, which goes away with the object.
class Baker {
public:
    /// `onlyDefault`: kernels of the scene's own integrator alone, which is several times as fast.
    Baker(std::string sceneFile, bool onlyDefault);
    ~Baker();
    Baker(const Baker&) = delete;
    Baker& operator=(const Baker&) = delete;

    /// The blob of a configuration of `levers`; baked when it is asked for first. Throws std::exception.
    std::string blobOf(const std::vector<Lever>& levers, const Configuration& configuration);

private:
    std::string sceneFile_;
    bool onlyDefault_;
    std::filesystem::path folder_;
    std::map<std::map<std::string, std::string>, std::string> blobs_;
};

}  // namespace cost
