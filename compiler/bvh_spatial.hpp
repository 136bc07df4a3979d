// Splits a range at a plane, cutting the triangles that cross it in two.
#pragma once
#include "bvh_split.hpp"

namespace minirtc {

/// When a split into pieces pays. All in half areas.
struct SpatialTerms {
    float leastOverlap = 0;  // of the halves without pieces, or none is looked for
    float leastGain = 0;     // of the whole tree by a further piece, by estimate
};

/// Replaces `halves`, those of the best split of whole refs, by ones that a plane parts, where that costs less [Stich, Friedrich and Dietrich
/// 2009, "Spatial Splits in Bounding Volume Hierarchies"]: triangles that cross it get a piece on each side, or go to one side whole where that
/// costs less; spheres stay whole. Makes no more pieces than there is room for. A pure function of its input.
void splitSpatially(const Geometry& geometry, const Range& range, const SpatialTerms& terms, Halves& halves);

}  // namespace minirtc
