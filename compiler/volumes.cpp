#include "volumes.hpp"

#include <algorithm>
#include <numeric>

namespace minirtc {
namespace {

/// Of the bounds of each body.
std::vector<double> boxVolumes(const Geometry& geometry) {
    std::vector<double> sizes;
    for (const Bounds& bounds : bodyBounds(geometry)) {
        const glm::dvec3 size(bounds.max - bounds.min);
        sizes.push_back(size.x * size.y * size.z);
    }
    return sizes;
}

}  // namespace

Volumes analyseVolumes(const Scene&, const Geometry& geometry, Diagnostics&) {
    Volumes volumes;
    const std::vector<double> sizes = boxVolumes(geometry);
    volumes.order.resize(geometry.bodies.size());
    std::iota(volumes.order.begin(), volumes.order.end(), 0u);
    std::stable_sort(volumes.order.begin(), volumes.order.end(), [&](uint32_t a, uint32_t b) {
        const Body &bodyA = geometry.bodies[a], &bodyB = geometry.bodies[b];
        if (bodyA.isVolume() != bodyB.isVolume()) return bodyA.isVolume();
        if (bodyA.priority != bodyB.priority) return bodyA.priority < bodyB.priority;
        return sizes[a] > sizes[b];
    });
    for (const Body& body : geometry.bodies) volumes.count += body.isVolume() ? 1 : 0;
    volumes.capacity = std::min(volumes.count, kMostNested);
    if (volumes.count > 1) volumes.overlap = "several volumes";
    return volumes;
}

}  // namespace minirtc
