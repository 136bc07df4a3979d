// The levers of the bake: the scene is baked once more for each choice of them.
#pragma once
#include <filesystem>
#include <map>
#include <prepared_scene.hpp>
#include <string>
#include <vector>

#include "render_levers.hpp"

namespace cost {

/// What a setting of a lever of the bake is called in a sentence, such as "exact Fresnel".
std::string wordsOf(const std::string& lever, const std::string& setting);

/// A scene file's levers and blobs, in a folder of its own that goes away with the object. What no lever changes is made once.
class Baker {
public:
    /// Prints the scene's warnings. Throws std::exception.
    explicit Baker(const std::string& sceneFile);
    ~Baker();
    Baker(const Baker&) = delete;
    Baker& operator=(const Baker&) = delete;

    /// All levers of the bake, with the reason of those that can change nothing in this scene.
    std::vector<Lever> levers() const;

    /// The blobs of configurations of `levers`; those not asked for before are baked, their kernels side by side. Where two hold the same kernels for the same
    /// data, they are one. Without levers of the rendering: of all integrators that are of use. Throws std::exception.
    std::vector<std::string> blobsOf(const std::vector<Lever>& levers, const std::vector<Configuration>& configurations);

private:
    struct Wish {
        minirtc::LeverSettings settings;
        std::vector<minirtc::Integrator> integrators;
        bool operator<(const Wish& other) const {
            return settings != other.settings ? settings < other.settings : integrators < other.integrators;
        }
    };

    Wish wishOf(const std::vector<Lever>& levers, const Configuration& configuration) const;
    void bake(const std::vector<Wish>& wishes);

    minirtc::PreparedScene prepared_;
    minirtc::KernelCompiler compiler_{0};
    std::vector<minirtc::Integrator> integrators_;  // Whitted's alone where the scene asks for it, else all
    std::filesystem::path folder_;
    std::map<Wish, std::string> blobs_;
    std::map<std::vector<uint32_t>, std::string> contents_;  // by what a blob holds, as far as levers change it
};

}  // namespace cost
