// Rays against a scene on the device, by the renderer's own traversal.
#pragma once
#include <memory>
#include <vector>

#include "blob.hpp"
#include "oracle.hpp"

struct minirt_context;

namespace test {

struct QueryHit {
    float t;             // in lengths of the ray's direction; tMax for a miss
    uint32_t primitive;  // index into Geometry::primitives; oracle::kNone for a miss
    bool hit() const { return primitive != oracle::kNone; }
};

struct QueryStats {
    double gpuMs = 0;
    uint64_t dispatches = 0;
    uint64_t resumed = 0;  // dispatches that went on with rays whose budget of steps was spent
};

enum class QueryMode { closest, any };

/// A scene whose blob holds one kernel: shaders/kernels/rays.comp. Positions are those of Geometry, relative to its origin.
/// Every failure is a std::runtime_error.
class RayQuery {
public:
    /// `context` must outlive the object.
    RayQuery(minirt_context* context, const minirtc::Scene& scene, const minirtc::Geometry& geometry,
             minirtc::LayoutChoice layout);
    ~RayQuery();
    RayQuery(RayQuery&&) noexcept;

    /// The hit of each ray; any one of them in QueryMode::any. tMin must be 0.
    std::vector<QueryHit> trace(const std::vector<oracle::Ray>& rays, QueryMode mode);
    /// Of the last trace.
    const QueryStats& stats() const;

private:
    struct Device;
    std::unique_ptr<Device> device_;
};

}  // namespace test
