// Rays through the renderer's own traversal: shaders/kernels/rays.comp in a blob that is baked in memory.
#pragma once
#include <memory>
#include <vector>

#include "blob.hpp"
#include "ray_sets.hpp"

struct minirt_context;

namespace bench {

/// Bytes of the hierarchy and the primitives alone: the rest of a blob does not grow with the mesh.
struct SceneBytes {
    uint64_t blob = 0;
    uint64_t device = 0;
};

/// What the kernel does for one ray (shaders/effects/profile.glsl). Passes are those of a subgroup, counted by one of its lanes: they mean something
/// in sums alone.
struct RayWork {
    uint32_t nodeSteps, triangleTests, leaves;
    uint32_t subgroupSize;
    uint32_t nodePasses, trianglePasses;            // with a lane in them
    uint32_t emptyNodePasses, emptyTrianglePasses;  // with none, which run all the same where lanes are masked
};

/// The scene that rays are traced in, and how.
struct RayScene {
    const minirtc::Scene& scene;
    const minirtc::Geometry& geometry;
    const minirtc::Bvh& bvh;
    minirtc::LayoutChoice layout = minirtc::LayoutChoice::automatic;
};

class RayKernel {
public:
    /// Counting takes time, so kernels that count are not those that are timed.
    enum class Counting { off, on };

    /// `context` must outlive the object. Throws std::runtime_error, also where kernels shall count on a device without subgroup ballots.
    RayKernel(minirt_context* context, const RayScene& scene, Counting counting = Counting::off);
    /// Makes the pipeline of the kernel that is timed once more, for a driver's statistics; it needs the scene on the device too. Throws std::runtime_error.
    static void makePipeline(minirt_context* context, const RayScene& scene);
    ~RayKernel();
    RayKernel(const RayKernel&) = delete;
    RayKernel& operator=(const RayKernel&) = delete;

    /// Uploads the rays of all later calls.
    void setRays(const std::vector<Ray>& rays);
    /// Milliseconds: by the device's clock on a GPU; on a CPU device by the wall's, from before the first submission to after the last.
    double trace(bool anyHit);
    /// Whether the device has clocks of its own.
    bool isGpu() const;
    /// Of the last trace, by primitive of the Geometry.
    std::vector<Hit> hits();
    /// Of the last trace by kernels that count: of whole groups, the last of which has a few idle rays at its end.
    std::vector<RayWork> work();

    const char* layout() const;
    SceneBytes bytes() const;
    /// What a node step and a triangle test fetch on the device.
    uint32_t nodeBytes() const;
    uint32_t primitiveBytes() const;

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

}  // namespace bench
