// What minirt-bench found, for people and for programs.
#pragma once
#include <nlohmann/json.hpp>

#include "effects_bench.hpp"
#include "frames.hpp"
#include "ray_bench.hpp"
#include "scaling.hpp"
#include "tree_bench.hpp"

namespace bench {

using Json = nlohmann::ordered_json;

Json toJson(const Spread& spread);
Json toJson(const StartSpreads& start);
Json toJson(const LoadResult& load);
Json toJson(const std::vector<KernelStatistics>& statistics);
Json toJson(const RayProfile& profile);
Json toJson(const std::vector<RaySetResult>& results);
Json toJson(const std::vector<TreeResult>& results);
Json toJson(const std::vector<Scaling>& results);
Json toJson(const SceneResult& result);
Json toJson(const EffectsResult& result);

void print(const std::vector<RaySetResult>& results);
/// `statistics`: of the kernel that was timed.
void printProfile(const std::vector<RaySetResult>& results, const std::vector<KernelStatistics>& statistics);
void print(const std::vector<TreeResult>& results);
void print(const std::vector<Scaling>& results);
void print(const SceneResult& result);
/// Rows of a table in Markdown.
void print(const std::vector<EffectsResult>& results);

}  // namespace bench
