// From the text of a scene to floats: baked by minirtc's own command, rendered by the runtime.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "gpu_context.hpp"
#include "support.hpp"

namespace test {

struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> rgba;
    minirt_stats stats = {};

    glm::vec3 at(uint32_t x, uint32_t y) const {
        const float* pixel = &rgba[4 * (size_t{y} * width + x)];
        return {pixel[0], pixel[1], pixel[2]};
    }
    bool operator==(const Picture& other) const;  // bit for bit
};

/// Which a blob holds: those of the scene's own integrator, or of all that can draw it. The fewer, the sooner.
enum class Kernels { ofDefault, ofAll };

/// Writes `json` as a scene file into `dir`, where the files that it names lie, and bakes it. Warnings go to stderr.
std::filesystem::path bakeScene(const TemporaryDir& dir, const std::string& json,
                                minirtc::LayoutChoice layout = minirtc::LayoutChoice::automatic,
                                Kernels kernels = Kernels::ofDefault);

/// The same with all options of the command but the names of the files, of which the blob's is `name`.mrt.
std::filesystem::path bakeScene(const TemporaryDir& dir, const std::string& json, const std::string& name,
                                minirtc::BakeOptions options);

/// A blob on a device. A failure of the runtime is a std::runtime_error with its message.
class LoadedScene {
public:
    LoadedScene(const GpuContext& gpu, const std::filesystem::path& blob);
    ~LoadedScene();
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    minirt_scene* get() const { return scene_; }
    /// `desc`.stats is set by the function. Fails the running case where a counter of the statistics tells of lost rays or NaNs.
    Picture render(minirt_render_desc desc = {}) const;

private:
    const GpuContext& gpu_;
    minirt_scene* scene_ = nullptr;
};

/// All in one: the picture of a scene, with the size, samples and depth that it names.
Picture renderScene(const GpuContext& gpu, const TemporaryDir& dir, const std::string& json);
Picture renderScene(const GpuContext& gpu, const std::string& json);

/// The same by a kernel with every effect.
Picture renderWithAllEffects(const GpuContext& gpu, const TemporaryDir& dir, const std::string& json);

}  // namespace test
