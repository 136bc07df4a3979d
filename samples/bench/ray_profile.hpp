// What bounds traversal: the work of a ray, what it fetches, how full the lanes are.
#pragma once
#include <cstdint>
#include <vector>

#include "agreement.hpp"
#include "ray_kernel.hpp"

namespace bench {

/// Of all rays of a set.
struct WorkCount {
    double mean = 0;
    uint32_t percentile99 = 0;
    uint32_t most = 0;
};

/// A loop of traversal, which takes all lanes of a subgroup along in every pass.
struct LoopLanes {
    double passes = 0;  // of subgroups, a ray
    double empty = 0;   // of these, the share with no lane in them; 0 where lanes are not masked
    double inUse = 0;   // share of the passes' lanes that were of use
    double bound = 0;   // the same if no subgroup took more passes than its longest ray; what is less waits for other loops
};

/// Of one set of rays.
struct RayProfile {
    uint32_t subgroupSize = 0;
    WorkCount nodeSteps, triangleTests, leaves;
    double nodeBytes = 0, triangleBytes = 0;  // that a ray fetches, caches or not
    LoopLanes nodeLanes, triangleLanes;
    double ns = 0;   // a ray by the kernel that does not count: of the device on a GPU, else of one processor thread
    Agreement hits;  // of both kernels
    double stepsPerSecond() const { return nodeSteps.mean / ns * 1e9; }
    double bytesPerSecond() const { return (nodeBytes + triangleBytes) / ns * 1e9; }
};

/// `work`: that of `rays` rays, and behind them of those that fill the last group; groups as RayKernel makes them. `nodeBytes`, `triangleBytes`: what a step and a test fetch.
/// Without `ns` and `hits`.
RayProfile profileOf(const std::vector<RayWork>& work, size_t rays, uint32_t nodeBytes, uint32_t triangleBytes);

}  // namespace bench
