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

constexpr size_t kGroup = 64;

/// Place in its group of the ray that a lane takes: Morton order over 8 x 8, as in shaders/kernels/rays_once.comp.
size_t placeOf(size_t lane) {
    const size_t x = (lane & 1) | (lane >> 1 & 2) | (lane >> 2 & 4), y = (lane >> 1 & 1) | (lane >> 2 & 2) | (lane >> 3 & 4);
    return y * 8 + x;
}

/// Summed over the subgroups, what the ray with most of it has.
uint64_t sumOfLongest(const std::vector<RayWork>& work, Member member) {
    const size_t lanes = std::min<size_t>(work.front().subgroupSize, kGroup);
    uint64_t total = 0;
    for (size_t group = 0; group < work.size(); group += kGroup)
        for (size_t first = 0; first < kGroup; first += lanes) {
            uint32_t longest = 0;
            for (size_t lane = first; lane < first + lanes; ++lane)
                longest = std::max(longest, work[group + placeOf(lane)].*member);
            total += longest;
        }
    return total;
}

/// Idle rays at the end of the last group take part in passes but are of no use.
LoopLanes lanesOf(const std::vector<RayWork>& work, size_t rays, Member useful, Member passes, Member empty) {
    const auto count = static_cast<double>(rays), lanes = static_cast<double>(work.front().subgroupSize);
    const auto longest = static_cast<double>(sumOfLongest(work, useful)) / count;
    const auto none = static_cast<double>(sum(work, empty)) / count;
    const double mean = countOf({work.begin(), work.begin() + static_cast<std::ptrdiff_t>(rays)}, useful).mean;
    LoopLanes loop;
    loop.passes = static_cast<double>(sum(work, passes)) / count + none;
    if (longest == 0) return loop;
    loop.empty = none / loop.passes;
    loop.inUse = mean / (loop.passes * lanes);
    loop.bound = mean / (longest * lanes);
    return loop;
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
    profile.nodeLanes = lanesOf(work, rays, &RayWork::nodeSteps, &RayWork::nodePasses, &RayWork::emptyNodePasses);
    profile.triangleLanes = lanesOf(work, rays, &RayWork::triangleTests, &RayWork::trianglePasses, &RayWork::emptyTrianglePasses);
    return profile;
}

}  // namespace bench
