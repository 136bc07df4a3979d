// Rays per second of the traversal and of its peers, over one mesh.
#pragma once
#include <optional>

#include "agreement.hpp"
#include "driver_pipeline.hpp"
#include "meshes.hpp"
#include "ray_profile.hpp"
#include "timing.hpp"

namespace bench {

struct RayBenchOptions {
    uint32_t width = 0, height = 0;
    uint32_t perHit = 1;  // secondary rays
    int rounds = 7;
    uint32_t seed = 1;
    bool alone = false;  // without peers
};

struct ContenderResult {
    std::string name;
    Spread mraysPerSecond;
    Spread processorNs;                  // a ray
    Spread ratio;                        // minirt's rays per second over this one's, round by round
    Spread processorRatio;               // the same by the processor time that they took
    std::optional<Agreement> agreement;  // with minirt; absent where nobody looked
    bool mustAgree = false;
};

/// One kind of rays. The first contender is minirt.
struct RaySetResult {
    std::string rays;
    size_t count = 0;
    size_t hits = 0;
    std::vector<ContenderResult> contenders;
    std::optional<RayProfile> profile = {};  // where a kernel that counts was there
    /// So it is with every contender that must agree, and with the kernel that counts.
    bool agrees() const;
};

/// Of one mesh: primary, shadow, diffuse and the diffuse ones in random order. `counting`, a kernel that counts, and `pipeline` may be null.
std::vector<RaySetResult> benchRays(const Mesh& mesh, RayKernel& kernel, RayKernel* counting, DriverPipeline* pipeline,
                                    const RayBenchOptions& options);

}  // namespace bench
