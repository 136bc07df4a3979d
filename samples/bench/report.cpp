#include "report.hpp"

#include <cstdio>

namespace bench {

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

}  // namespace bench
