#include "ray_profile.hpp"

#include <algorithm>

namespace bench {
namespace {

using Member = uint32_t RayWork::*;

uint64_t sum(const std::vector<RayWork>& work, Member member) {
    uint64_t total = 0;
    for (const RayWork& one : work) total += one.*member;
    return total;
}

WorkCount countOf(const std::vector<RayWork>& work, Member member) {
    std::vector<uint32_t> values;
    values.reserve(work.size());
    for (const RayWork& one : work) values.push_back(one.*member);
    WorkCount count;
    count.mean = static_cast<double>(sum(work, member)) / static_cast<double>(work.size());
    const size_t rank = (work.size() * 99 + 99) / 100 - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
    count.percentile99 = values[rank];
    count.most = *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
    return count;
}

/// Idle rays at the end of the last group take part in passes but are of no use.
LoopLanes lanesOf(uint64_t useful, const std::vector<RayWork>& work, Member passes, Member empty) {
    const uint64_t none = sum(work, empty), all = sum(work, passes) + none;
    if (all == 0) return {};
    const double lanes = static_cast<double>(all) * work.front().subgroupSize;
    return {static_cast<double>(useful) / lanes, static_cast<double>(none) / static_cast<double>(all)};
}

}  // namespace

RayProfile profileOf(const std::vector<RayWork>& work, size_t rays, uint32_t nodeBytes, uint32_t triangleBytes) {
    RayProfile profile;
    if (rays == 0) return profile;
    const std::vector<RayWork> own(work.begin(), work.begin() + static_cast<std::ptrdiff_t>(rays));
    profile.subgroupSize = own.front().subgroupSize;
    profile.nodeSteps = countOf(own, &RayWork::nodeSteps);
    profile.triangleTests = countOf(own, &RayWork::triangleTests);
    profile.leaves = countOf(own, &RayWork::leaves);
    profile.nodeBytes = profile.nodeSteps.mean * nodeBytes;
    profile.triangleBytes = profile.triangleTests.mean * triangleBytes;
    profile.nodeLanes = lanesOf(sum(own, &RayWork::nodeSteps), work, &RayWork::nodePasses, &RayWork::emptyNodePasses);
    profile.triangleLanes =
        lanesOf(sum(own, &RayWork::triangleTests), work, &RayWork::trianglePasses, &RayWork::emptyTrianglePasses);
    return profile;
}

}  // namespace bench
