#include "effects_bench.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "../common/wake.hpp"
#include "commands.hpp"
#include "stage.hpp"
#include "start_bench.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;

/// A blob, and the bytes of its kernels.
size_t bake(const fs::path& scene, const fs::path& blob, bool all) {
    const fs::path stats = fs::path(blob).replace_extension(".json");
    minirtc::BakeOptions options;
    options.scene = scene.string();
    options.output = blob.string();
    options.statsFile = stats.string();
    options.onlyDefault = true;
    options.choices.allEffects = all;
    options.quiet = true;
    minirtc::bake(options);
    std::ifstream file(stats);
    return nlohmann::json::parse(file).at("spirv_bytes").get<size_t>();
}

const char* nameOf(uint32_t integrator) {
    const char* const names[] = {"whitted", "path", "wavefront", "whitted_shared"};
    return names[integrator - MINIRT_INTEGRATOR_WHITTED];
}

}  // namespace

EffectsResult benchEffects(const fs::path& scene, const EffectsOptions& options) {
    const TemporaryFolder folder;
    const fs::path blobs[] = {folder.path() / "pruned.mrt", folder.path() / "whole.mrt"};
    EffectsResult result;
    result.scene = scene.stem().string();
    KernelResult* const kernels[] = {&result.pruned, &result.whole};
    useShaderCache(folder.path());
    std::vector<Contender> contenders;
    std::vector<std::unique_ptr<Stage>> stages;
    for (size_t i = 0; i < 2; ++i) {
        kernels[i]->spirvBytes = bake(scene, blobs[i], i == 1);
        kernels[i]->firstDispatchMs = start(options.device, blobs[i], folder.path()).pipeline;
        stages.push_back(std::make_unique<Stage>(options.device, blobs[i].string()));
        Stage& stage = *stages.back();
        stage.load();
        stage.resize(options.width, options.height);
        contenders.push_back({i ? "whole" : "pruned", [&stage, &options] {
                                  return stage.pictureMs(MINIRT_INTEGRATOR_SCENE, options.samples) / options.samples;
                              }});
    }
    result.integrator = nameOf(stages[0]->scene().integrator);
    result.width = options.width ? options.width : stages[0]->scene().width;
    result.height = options.height ? options.height : stages[0]->scene().height;
    if (!stages[0]->device().is_cpu) runFor(kWakeMs, contenders[0].run);
    const std::vector<Times> times = takeTurns(contenders, options.rounds);
    for (size_t i = 0; i < 2; ++i) kernels[i]->msPerSample = spreadOf(times[i].ms);
    for (size_t i = 0; i < 2; ++i) kernels[i]->statistics = kernelStatistics(options.device, blobs[i].string());
    result.speedup = ratioTo(times[1].ms, times[0].ms);
    return result;
}

}  // namespace bench
