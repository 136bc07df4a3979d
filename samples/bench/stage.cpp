#include "stage.hpp"

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace bench {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "minirt-bench.XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be made");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

Stage::Stage(const std::string& device, const std::string& blob, PFN_vkGetInstanceProcAddr functions) : blob_(blob) {
    minirt_context_desc desc = {};
    desc.device_name = device.c_str();
    desc.host.get_instance_proc_addr = functions;
    minirt_context* context = nullptr;
    const minirt_result result = minirt_create(&desc, &context);
    if (result) throw std::runtime_error(minirt_result_string(result));
    context_.reset(context);
}

void Stage::load() {
    require(minirt_load_file(context_.get(), blob_.c_str(), &scene_));
}

minirt_scene_desc Stage::scene() const {
    minirt_scene_desc desc;
    minirt_get_scene_desc(scene_, &desc);
    return desc;
}

minirt_device_info Stage::device() const {
    minirt_device_info info;
    minirt_get_device_info(context_.get(), &info);
    return info;
}

void Stage::resize(uint32_t width, uint32_t height) {
    width_ = width;
    height_ = height;
}

bool Stage::render(minirt_integrator integrator, uint32_t samples, minirt_stats& stats) {
    const minirt_scene_desc own = scene();
    minirt_render_desc desc = {};
    desc.width = width_ ? width_ : own.width;
    desc.height = height_ ? height_ : own.height;
    desc.integrator = integrator;
    desc.samples = samples;
    desc.stats = &stats;
    picture_.resize(size_t{desc.width} * desc.height * 4);
    const minirt_result result = minirt_render(scene_, &desc, picture_.data());
    if (result == MINIRT_ERROR_NO_KERNEL) return false;
    require(result);
    return true;
}

double Stage::pictureMs(minirt_integrator integrator, uint32_t samples) {
    minirt_stats stats = {};
    render(integrator, samples, stats);
    return device().is_cpu ? stats.wall_ms : stats.gpu_ms;
}

void Stage::require(minirt_result result) const {
    if (result) throw std::runtime_error(blob_ + ": " + minirt_last_message(context_.get()));
}

/// Mesa's and NVIDIA's drivers look for their caches when a device is opened.
void useShaderCache(const fs::path& folder) {
    for (const char* variable : {"MESA_SHADER_CACHE_DIR", "__GL_SHADER_DISK_CACHE_PATH"}) setenv(variable, folder.c_str(), 1);
    setenv("__GL_SHADER_DISK_CACHE", "1", 1);
}

}  // namespace bench
