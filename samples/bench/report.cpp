#include "report.hpp"

#include <algorithm>
#include <cstdio>

namespace bench {
namespace {

Json toJson(const StartResult& start) {
    return {{"context_ms", start.context},
            {"load_ms", start.load},
            {"upload_ms", start.upload},
            {"pipeline_ms", start.pipeline},
            {"first_pixel_ms", start.firstPixel}};
}

void print(const char* name, const StartResult& start) {
    std::printf("  %-24s first pixel after %.1f ms: context %.1f, load %.1f, upload %.1f, pipeline and first dispatch %.1f\n",
                name, start.firstPixel, start.context, start.load, start.upload, start.pipeline);
}

/// "48 of 96": a figure that drivers name by one of `words`, of the pruned kernel and of the whole one.
std::string pairOf(const EffectsResult& result, const std::vector<std::string>& words) {
    const double pruned = largestFigure(result.pruned.statistics, words);
    const double whole = largestFigure(result.whole.statistics, words);
    if (pruned < 0 || whole < 0) return "not told";
    char text[64];
    std::snprintf(text, sizeof text, "%.0f of %.0f", pruned, whole);
    return text;
}

}  // namespace

Json toJson(const Spread& spread) {
    return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}};
}

Json toJson(const std::vector<RaySetResult>& results) {
    Json json;
    for (const RaySetResult& set : results) {
        Json contenders;
        for (const ContenderResult& c : set.contenders) {
            Json& entry = contenders[c.name] = {{"mrays_per_s", toJson(c.mraysPerSecond)},
                                                {"processor_ns_per_ray", toJson(c.processorNs)},
                                                {"minirt_over_this", toJson(c.ratio)},
                                                {"minirt_over_this_by_processor_time", toJson(c.processorRatio)}};
            if (c.agreement) entry["differing"] = {{"hit_or_miss", c.agreement->onlyOne}, {"distance", c.agreement->distance}};
        }
        json[set.rays] = {{"rays", set.count}, {"hits", set.hits}, {"tracers", contenders}};
    }
    return json;
}

Json toJson(const std::vector<TreeResult>& results) {
    Json json;
    for (const TreeResult& tree : results)
        json[tree.name] = {{"mtriangles_per_s", toJson(tree.mtrianglesPerSecond)},
                           {"sah_cost", tree.sahCost},
                           {"nodes", tree.nodes},
                           {"references", tree.references}};
    return json;
}

Json toJson(const SceneResult& result) {
    Json json = {{"scene", result.scene}, {"width", result.width}, {"height", result.height}, {"blob_bytes", result.blobBytes}};
    if (result.bakeMs > 0) json["bake_ms"] = result.bakeMs;
    json["start"] = {{"cold", toJson(result.cold)}, {"cached", toJson(result.cached)}};
    for (const FrameResult& frame : result.frames)
        json["frames"][frame.integrator] = {{"ms_per_sample", toJson(frame.msPerSample)},
                                            {"mrays_per_s", toJson(frame.mraysPerSecond)}};
    return json;
}

Json toJson(const EffectsResult& result) {
    const auto kernel = [](const KernelResult& k) {
        Json json = {
            {"spirv_bytes", k.spirvBytes}, {"first_dispatch_ms", k.firstDispatchMs}, {"ms_per_sample", toJson(k.msPerSample)}};
        for (const KernelStatistics& program : k.statistics) {
            Json figures = Json::object();
            for (const auto& [name, value] : program.figures) figures[name] = value;
            json["driver_statistics"].push_back({{"program", program.program}, {"figures", figures}});
        }
        return json;
    };
    return {{"scene", result.scene},
            {"integrator", result.integrator},
            {"pruned", kernel(result.pruned)},
            {"all_effects", kernel(result.whole)},
            {"speedup", toJson(result.speedup)}};
}

void print(const std::vector<RaySetResult>& results) {
    std::printf("  %-9s %-21s %26s %22s %10s %10s\n", "rays", "tracer", "Mrays/s (lowest-highest)", "minirt over it",
                "(cpu time)", "differing");
    for (const RaySetResult& set : results)
        for (const ContenderResult& c : set.contenders) {
            std::printf("  %-9s %-21s %10.2f (%6.2f-%7.2f) %8.2f (%5.2f-%5.2f) %10.2f", set.rays.c_str(), c.name.c_str(),
                        c.mraysPerSecond.median, c.mraysPerSecond.low, c.mraysPerSecond.high, c.ratio.median, c.ratio.low,
                        c.ratio.high, c.processorRatio.median);
            if (c.agreement) std::printf(" %10zu of %zu", c.agreement->differing(), c.agreement->rays);
            std::printf("\n");
        }
}

void print(const std::vector<TreeResult>& results) {
    std::printf("  %-31s %26s %8s %10s %11s\n", "hierarchy", "Mtris/s (lowest-highest)", "SAH", "nodes", "references");
    for (const TreeResult& tree : results)
        std::printf("  %-31s %10.2f (%6.2f-%7.2f) %8.2f %10zu %11zu\n", tree.name.c_str(), tree.mtrianglesPerSecond.median,
                    tree.mtrianglesPerSecond.low, tree.mtrianglesPerSecond.high, tree.sahCost, tree.nodes, tree.references);
}

void print(const SceneResult& result) {
    std::printf("%s: %u x %u, blob of %.1f MB", result.scene.c_str(), result.width, result.height,
                static_cast<double>(result.blobBytes) * 1e-6);
    if (result.bakeMs > 0) std::printf(", baked in %.0f ms", result.bakeMs);
    std::printf("\n");
    print("shaders compiled anew", result.cold);
    print("shaders from the cache", result.cached);
    for (const FrameResult& frame : result.frames)
        std::printf("  %-9s %10.2f ms a sample (%.2f-%.2f), %.2f Mrays/s\n", frame.integrator.c_str(), frame.msPerSample.median,
                    frame.msPerSample.low, frame.msPerSample.high, frame.mraysPerSecond.median);
}

void print(const std::vector<EffectsResult>& results) {
    const bool told =
        std::any_of(results.begin(), results.end(), [](const EffectsResult& e) { return !e.pruned.statistics.empty(); });
    std::printf("| scene, integrator | SPIR-V, kB | first dispatch, ms | ms a sample | times faster (lowest to highest) |%s\n",
                told ? " registers | stack, bytes |" : "");
    std::printf("|---|---|---|---|---|%s\n", told ? "---|---|" : "");
    for (const EffectsResult& e : results) {
        std::printf("| `%s` %s | %.0f of %.0f | %.0f of %.0f | %.3g of %.3g | %.2f (%.2f to %.2f) |", e.scene.c_str(),
                    e.integrator.c_str(), static_cast<double>(e.pruned.spirvBytes) * 1e-3,
                    static_cast<double>(e.whole.spirvBytes) * 1e-3, e.pruned.firstDispatchMs, e.whole.firstDispatchMs,
                    e.pruned.msPerSample.median, e.whole.msPerSample.median, e.speedup.median, e.speedup.low, e.speedup.high);
        if (told) std::printf(" %s | %s |", pairOf(e, {"egister"}).c_str(), pairOf(e, {"tack", "cratch", "ocal Mem"}).c_str());
        std::printf("\n");
    }
}

}  // namespace bench
