// Embree's hierarchies over our triangles, as ours, so that one function judges both.
#pragma once
#include "bvh.hpp"
#include "ray_sets.hpp"

namespace bench {

enum class EmbreeQuality { low, medium, high };  // Morton order; binned SAH; SAH with spatial splits

/// By rtcBuildBVH with our constants: two children, leaves of at most kMaxLeafSize, a node costs what a triangle costs. `buildMs` is
/// that of Embree alone, on all cores. Where triangles were split `order` has some twice. Empty without Embree.
minirtc::Bvh embreeTree(const Triangles& mesh, EmbreeQuality quality);

}  // namespace bench
