#include "frames.hpp"

#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "commands.hpp"
#include "minirt.h"

namespace bench {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the object.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "minirt-bench.XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be made");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

struct Destroy {
    void operator()(minirt_context* context) const { minirt_destroy(context); }
};

/// A device with one scene on it.
class Stage {
public:
    Stage(const std::string& device, const std::string& blob) : blob_(blob) {
        minirt_context_desc desc = {};
        desc.device_name = device.c_str();
        minirt_context* context = nullptr;
        const minirt_result result = minirt_create(&desc, &context);
        if (result) throw std::runtime_error(minirt_result_string(result));
        context_.reset(context);
    }

    void load() { require(minirt_load_file(context_.get(), blob_.c_str(), &scene_)); }

    minirt_scene_desc scene() const {
        minirt_scene_desc desc;
        minirt_get_scene_desc(scene_, &desc);
        return desc;
    }

    minirt_device_info device() const {
        minirt_device_info info;
        minirt_get_device_info(context_.get(), &info);
        return info;
    }

    /// False where the blob holds no kernel for the integrator.
    bool render(minirt_integrator integrator, uint32_t samples, minirt_stats& stats) {
        minirt_render_desc desc = {};
        desc.integrator = integrator;
        desc.samples = samples;
        desc.stats = &stats;
        const minirt_scene_desc own = scene();
        picture_.resize(size_t{own.width} * own.height * 4);
        const minirt_result result = minirt_render(scene_, &desc, picture_.data());
        if (result == MINIRT_ERROR_NO_KERNEL) return false;
        require(result);
        return true;
    }

    /// Begins a picture and takes its first step.
    minirt_stats firstStep() {
        minirt_render_desc desc = {};
        minirt_job* job = nullptr;
        require(minirt_begin(scene_, &desc, &job));
        require(minirt_step(job, nullptr));
        minirt_stats stats = {};
        require(minirt_get_stats(job, &stats));
        minirt_end(job);
        return stats;
    }

private:
    void require(minirt_result result) const {
        if (result) throw std::runtime_error(blob_ + ": " + minirt_last_message(context_.get()));
    }

    std::string blob_;
    std::unique_ptr<minirt_context, Destroy> context_;
    minirt_scene* scene_ = nullptr;
    std::vector<float> picture_;
};

/// Mesa's and NVIDIA's drivers look for their caches when a device is opened.
void useShaderCache(const fs::path& folder) {
    for (const char* variable : {"MESA_SHADER_CACHE_DIR", "__GL_SHADER_DISK_CACHE_PATH"}) setenv(variable, folder.c_str(), 1);
    setenv("__GL_SHADER_DISK_CACHE", "1", 1);
}

StartResult start(const std::string& device, const std::string& blob) {
    StartResult result;
    const double begin = nowMs();
    Stage stage(device, blob);
    result.context = nowMs() - begin;
    stage.load();
    const minirt_stats stats = stage.firstStep();
    result.firstPixel = nowMs() - begin;
    result.load = stats.load_ms;
    result.upload = stats.upload_ms;
    result.pipeline = stats.pipeline_ms;
    return result;
}

std::vector<FrameResult> benchFrames(Stage& stage, const FrameOptions& options) {
    const std::pair<const char*, minirt_integrator> integrators[] = {
        {"whitted", MINIRT_INTEGRATOR_WHITTED}, {"path", MINIRT_INTEGRATOR_PATH}, {"wavefront", MINIRT_INTEGRATOR_WAVEFRONT}};
    const bool cpu = stage.device().is_cpu != 0;
    std::vector<FrameResult> results;
    std::vector<Contender> contenders;
    std::vector<std::vector<double>> mrays(std::size(integrators));
    for (const auto& [name, integrator] : integrators) {
        minirt_stats stats = {};
        if (!stage.render(integrator, 1, stats)) continue;
        std::vector<double>& rates = mrays[results.size()];
        results.push_back({name, {}, {}});
        contenders.push_back({name, [&stage, &options, &rates, one = integrator, cpu] {
                                  minirt_stats s = {};
                                  stage.render(one, options.samples, s);
                                  const double ms = cpu ? s.wall_ms : s.gpu_ms;
                                  rates.push_back(static_cast<double>(s.primary_rays + s.shadow_rays + s.secondary_rays) / ms *
                                                  1e-3);
                                  return ms / options.samples;
                              }});
    }
    const std::vector<Times> times = takeTurns(contenders, options.rounds);
    for (size_t i = 0; i < results.size(); ++i) {
        results[i].msPerSample = spreadOf(times[i].ms);
        results[i].mraysPerSecond = spreadOf({mrays[i].begin() + 1, mrays[i].end()});  // the first round does not count
    }
    return results;
}

}  // namespace

SceneResult benchScene(const fs::path& file, const FrameOptions& options) {
    const TemporaryFolder folder;
    SceneResult result;
    result.scene = file.stem().string();
    std::string blob = file.string();
    if (file.extension() == ".json") {
        minirtc::BakeOptions bake;
        bake.scene = blob;
        bake.output = blob = (folder.path() / "scene.mrt").string();
        bake.quiet = true;
        const double begin = nowMs();
        minirtc::bake(bake);
        result.bakeMs = nowMs() - begin;
    }
    result.blobBytes = fs::file_size(blob);
    useShaderCache(folder.path());
    result.cold = start(options.device, blob);
    result.cached = start(options.device, blob);
    Stage stage(options.device, blob);
    stage.load();
    result.width = stage.scene().width;
    result.height = stage.scene().height;
    result.frames = benchFrames(stage, options);
    return result;
}

}  // namespace bench
