// A scene on a device.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "minirt.h"

namespace bench {

/// A folder that goes with the object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// A device with one scene on it. Its functions throw std::runtime_error.
class Stage {
public:
    /// `functions`: where the runtime looks for Vulkan; null: in the loader that the system has.
    Stage(const std::string& device, const std::string& blob, PFN_vkGetInstanceProcAddr functions = nullptr);

    void load();
    minirt_scene_desc scene() const;
    minirt_device_info device() const;
    minirt_context* context() const { return context_.get(); }

    /// Width and height of later pictures; by default the scene's.
    void resize(uint32_t width, uint32_t height);

    /// False where the blob holds no kernel for the integrator.
    bool render(minirt_integrator integrator, uint32_t samples, minirt_stats& stats);

    /// Milliseconds of the picture: the device's, but on a CPU device those that pass.
    double pictureMs(minirt_integrator integrator, uint32_t samples);

private:
    struct Destroy {
        void operator()(minirt_context* context) const { minirt_destroy(context); }
    };
    void require(minirt_result result) const;

    std::string blob_;
    std::unique_ptr<minirt_context, Destroy> context_;
    minirt_scene* scene_ = nullptr;
    uint32_t width_ = 0, height_ = 0;  // 0: the scene's
    std::vector<float> picture_;
};

/// Drivers keep compiled shaders there from the next device on that is opened.
void useShaderCache(const std::filesystem::path& folder);

}  // namespace bench
