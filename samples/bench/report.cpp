#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

void print(const char* name, const StartSpreads& start) {
    std::printf(
        "  %-22s %7.1f ms (%.1f-%.1f) from nothing to a picture of 64 x 64; load %.1f, upload %.1f, pipelines and first dispatch "
        "%.1f\n",
        name, start.process.median, start.process.lower, start.process.upper, start.load.median, start.upload.median,
        start.pipeline.median);
}

void print(const LoadResult& load) {
    std::printf(
        "  load %.2f ms (%.2f GB/s): %.2f (%.2f-%.2f) of a copy to the device, %.2f (%.2f-%.2f) of one into buffers written "
        "before\n",
        load.load.median, static_cast<double>(load.bytes) / load.load.median * 1e-6, load.ratio.median, load.ratio.lower,
        load.ratio.upper, load.ratioAgain.median, load.ratioAgain.lower, load.ratioAgain.upper);
}

/// Words by which drivers name a figure.
const std::vector<std::string> kRegisters = {"egister"};
const std::vector<std::string> kStack = {"tack", "cratch", "ocal Mem"};

/// "48"
std::string toldBy(const std::vector<KernelStatistics>& statistics, const std::vector<std::string>& words) {
    const double largest = largestFigure(statistics, words);
    return largest < 0 ? "not told" : std::to_string(std::lround(largest));
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
    return {{"median", spread.median}, {"lower", spread.lower}, {"upper", spread.upper}};
}

Json toJson(const StartSpreads& start) {
    return {{"process_ms", toJson(start.process)},
            {"load_ms", toJson(start.load)},
            {"upload_ms", toJson(start.upload)},
            {"pipeline_ms", toJson(start.pipeline)}};
}

Json toJson(const LoadResult& load) {
    return {{"bytes", load.bytes},
            {"load_ms", toJson(load.load)},
            {"copy_ms", toJson(load.copy)},
            {"copy_again_ms", toJson(load.copyAgain)},
            {"copy_over_load", toJson(load.ratio)},
            {"copy_again_over_load", toJson(load.ratioAgain)}};
}

Json toJson(const std::vector<KernelStatistics>& statistics) {
    Json json = Json::array();
    for (const KernelStatistics& program : statistics) {
        Json figures = Json::object();
        for (const auto& [name, value] : program.figures) figures[name] = value;
        json.push_back({{"program", program.program}, {"figures", figures}});
    }
    return json;
}

Json toJson(const RayProfile& p) {
    const auto count = [](const WorkCount& c) {
        return Json{{"mean", c.mean}, {"percentile_99", c.percentile99}, {"most", c.most}};
    };
    const auto lanes = [](const LoopLanes& l) {
        return Json{{"passes", l.passes}, {"empty", l.empty}, {"in_use", l.inUse}, {"bound", l.bound}};
    };
    return {{"subgroup_size", p.subgroupSize},
            {"node_steps", count(p.nodeSteps)},
            {"triangle_tests", count(p.triangleTests)},
            {"leaves", count(p.leaves)},
            {"node_bytes", p.nodeBytes},
            {"triangle_bytes", p.triangleBytes},
            {"node_lanes", lanes(p.nodeLanes)},
            {"triangle_lanes", lanes(p.triangleLanes)},
            {"ns", p.ns},
            {"node_steps_per_s", p.stepsPerSecond()},
            {"bytes_per_s", p.bytesPerSecond()},
            {"differing", p.hits.differing()}};
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
        if (set.profile) json[set.rays]["profile"] = toJson(*set.profile);
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

Json toJson(const std::vector<Scaling>& results) {
    Json json = Json::array();
    for (const Scaling& s : results)
        json.push_back({{"rays", s.rays},
                        {"from_triangles", s.from},
                        {"to_triangles", s.to},
                        {"peer", s.peer},
                        {"kept", s.own},
                        {"kept_by_peer", s.peers},
                        {"ratio", s.ratio()},
                        {"kept_by_processor_time", s.ownByProcessor},
                        {"kept_by_peer_by_processor_time", s.peersByProcessor},
                        {"ratio_by_processor_time", s.ratioByProcessor()}});
    return json;
}

Json toJson(const SceneResult& result) {
    Json json = {{"scene", result.scene}, {"width", result.width}, {"height", result.height}, {"blob_bytes", result.blobBytes}};
    if (result.bakeMs > 0) json["bake_ms"] = result.bakeMs;
    json["start"] = {{"cold", toJson(result.starts.cold)}, {"second", toJson(result.starts.second)}};
    json["load"] = toJson(result.load);
    for (const FrameResult& frame : result.frames)
        json["frames"][frame.integrator] = {{"ms_per_sample", toJson(frame.msPerSample)},
                                            {"mrays_per_s", toJson(frame.mraysPerSecond)}};
    return json;
}

Json toJson(const EffectsResult& result) {
    const auto kernel = [](const KernelResult& k) {
        Json json = {
            {"spirv_bytes", k.spirvBytes}, {"first_dispatch_ms", k.firstDispatchMs}, {"ms_per_sample", toJson(k.msPerSample)}};
        if (k.statistics.empty()) return json;
        json["driver_statistics"] = toJson(k.statistics);
        for (const auto& [name, words] : {std::pair{"registers", &kRegisters}, std::pair{"stack_bytes", &kStack}})
            if (const double largest = largestFigure(k.statistics, *words); largest >= 0) json[name] = largest;
        return json;
    };
    return {{"scene", result.scene},
            {"integrator", result.integrator},
            {"width", result.width},
            {"height", result.height},
            {"pruned", kernel(result.pruned)},
            {"all_effects", kernel(result.whole)},
            {"speedup", toJson(result.speedup)}};
}

void print(const std::vector<RaySetResult>& results) {
    std::printf("  %-9s %-21s %26s %22s %10s %10s\n", "rays", "tracer", "Mrays/s (quartiles)", "minirt over it", "(cpu time)",
                "differing");
    for (const RaySetResult& set : results)
        for (const ContenderResult& c : set.contenders) {
            std::printf("  %-9s %-21s %10.2f (%6.2f-%7.2f) %8.2f (%5.2f-%5.2f) %10.2f", set.rays.c_str(), c.name.c_str(),
                        c.mraysPerSecond.median, c.mraysPerSecond.lower, c.mraysPerSecond.upper, c.ratio.median, c.ratio.lower,
                        c.ratio.upper, c.processorRatio.median);
            if (c.agreement) std::printf(" %10zu of %zu", c.agreement->differing(), c.agreement->rays);
            std::printf("\n");
        }
}

void printProfile(const std::vector<RaySetResult>& results, const std::vector<KernelStatistics>& statistics) {
    std::printf("  %-9s %23s %13s %6s %14s %19s %25s %8s %8s %6s\n", "profile", "node steps (99 %, most)", "tests (99 %)",
                "leaves", "bytes of both", "node passes, lanes", "test passes, lanes, empty", "ns", "Msteps/s", "GB/s");
    uint32_t subgroup = 0;
    for (const RaySetResult& set : results) {
        if (!set.profile) continue;
        const RayProfile& p = *set.profile;
        const LoopLanes &node = p.nodeLanes, &test = p.triangleLanes;
        subgroup = p.subgroupSize;
        std::printf(
            "  %-9s %9.1f (%5u, %5u) %7.2f (%3u) %6.2f %6.0f + %5.0f %6.2f %2.0f of %2.0f %% %7.2f %2.0f of %2.0f %% %5.0f %% "
            "%8.2f %8.0f %6.2f\n",
            set.rays.c_str(), p.nodeSteps.mean, p.nodeSteps.percentile99, p.nodeSteps.most, p.triangleTests.mean,
            p.triangleTests.percentile99, p.leaves.mean, p.nodeBytes, p.triangleBytes, node.passes, 100 * node.inUse,
            100 * node.bound, test.passes, 100 * test.inUse, 100 * test.bound, 100 * test.empty, p.ns, p.stepsPerSecond() * 1e-6,
            p.bytesPerSecond() * 1e-9);
    }
    std::printf("  %u lanes in a subgroup; registers %s, stack %s\n", subgroup, toldBy(statistics, kRegisters).c_str(),
                toldBy(statistics, kStack).c_str());
}

void print(const std::vector<TreeResult>& results) {
    std::printf("  %-31s %26s %8s %10s %11s\n", "hierarchy", "Mtris/s (quartiles)", "SAH", "nodes", "references");
    for (const TreeResult& tree : results)
        std::printf("  %-31s %10.2f (%6.2f-%7.2f) %8.2f %10zu %11zu\n", tree.name.c_str(), tree.mtrianglesPerSecond.median,
                    tree.mtrianglesPerSecond.lower, tree.mtrianglesPerSecond.upper, tree.sahCost, tree.nodes, tree.references);
}

void print(const std::vector<Scaling>& results) {
    std::printf("Rays per second that are left on the larger mesh (by processor time):\n  %-9s %19s %15s %22s %15s\n", "rays",
                "triangles", "minirt", "peer", "minirt over it");
    for (const Scaling& s : results)
        std::printf("  %-9s %8llu to %8llu %6.2f (%6.2f) %14s %6.2f (%6.2f) %6.2f (%6.2f)\n", s.rays.c_str(),
                    static_cast<unsigned long long>(s.from), static_cast<unsigned long long>(s.to), s.own, s.ownByProcessor,
                    s.peer.c_str(), s.peers, s.peersByProcessor, s.ratio(), s.ratioByProcessor());
}

void print(const SceneResult& result) {
    std::printf("%s: %u x %u, blob of %.1f MB", result.scene.c_str(), result.width, result.height,
                static_cast<double>(result.blobBytes) * 1e-6);
    if (result.bakeMs > 0) std::printf(", baked in %.0f ms", result.bakeMs);
    std::printf("\n");
    print("first start", result.starts.cold);
    print("second start", result.starts.second);
    print(result.load);
    for (const FrameResult& frame : result.frames)
        std::printf("  %-9s %10.2f ms a sample (%.2f-%.2f), %.2f Mrays/s\n", frame.integrator.c_str(), frame.msPerSample.median,
                    frame.msPerSample.lower, frame.msPerSample.upper, frame.mraysPerSecond.median);
}

void print(const std::vector<EffectsResult>& results) {
    const bool told =
        std::any_of(results.begin(), results.end(), [](const EffectsResult& e) { return !e.pruned.statistics.empty(); });
    std::printf("| scene, integrator | SPIR-V, kB | first dispatch, ms | ms a sample | times faster (quartiles) |%s\n",
                told ? " registers | stack, bytes |" : "");
    std::printf("|---|---|---|---|---|%s\n", told ? "---|---|" : "");
    for (const EffectsResult& e : results) {
        std::printf("| `%s` %s | %.0f of %.0f | %.0f of %.0f | %.3g of %.3g | %.2f (%.2f to %.2f) |", e.scene.c_str(),
                    e.integrator.c_str(), static_cast<double>(e.pruned.spirvBytes) * 1e-3,
                    static_cast<double>(e.whole.spirvBytes) * 1e-3, e.pruned.firstDispatchMs, e.whole.firstDispatchMs,
                    e.pruned.msPerSample.median, e.whole.msPerSample.median, e.speedup.median, e.speedup.lower, e.speedup.upper);
        if (told) std::printf(" %s | %s |", pairOf(e, kRegisters).c_str(), pairOf(e, kStack).c_str());
        std::printf("\n");
    }
}

}  // namespace bench
