#include "frames.hpp"

#include "../common/wake.hpp"
#include "commands.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;

std::vector<FrameResult> benchFrames(Stage& stage, const FrameOptions& options) {
    const std::pair<const char*, minirt_integrator> integrators[] = {{"whitted", MINIRT_INTEGRATOR_WHITTED},
                                                                     {"path", MINIRT_INTEGRATOR_PATH},
                                                                     {"wavefront", MINIRT_INTEGRATOR_WAVEFRONT},
                                                                     {"whitted_shared", MINIRT_INTEGRATOR_WHITTED_SHARED}};
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
    if (!cpu) runFor(kWakeMs, [&] { return stage.pictureMs(MINIRT_INTEGRATOR_SCENE, 1); });
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
    result.starts = benchStarts(options.device, blob, options.rounds);
    useShaderCache(folder.path());
    Stage stage(options.device, blob);
    stage.load();
    result.load = benchLoad(stage.context(), blob, options.rounds);
    result.width = stage.scene().width;
    result.height = stage.scene().height;
    if (options.pictures) result.frames = benchFrames(stage, options);
    return result;
}

}  // namespace bench
