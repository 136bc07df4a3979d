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

class RayKernel {
public:
    /// `context` must outlive the object. Throws std::runtime_error.
    RayKernel(minirt_context* context, const minirtc::Scene& scene, const minirtc::Geometry& geometry, const minirtc::Bvh& bvh,
              minirtc::LayoutChoice layout);
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

    const char* layout() const;
    SceneBytes bytes() const;

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

}  // namespace bench
