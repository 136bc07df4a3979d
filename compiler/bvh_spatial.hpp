// Splits primitives that fill little of their boxes into pieces, so that the builder can part them.
#pragma once
#include "bvh.hpp"
#include "parallel.hpp"

namespace minirtc {

/// The box of what of a primitive lies between some planes, rounded outwards: every point of the primitive is in the box of one of its pieces.
struct Piece {
    Aabb box;
    uint32_t primitive;
};

/// One piece a primitive, in their order, then at most `share` times as many more: triangles are cut where the area of boxes falls most, the
/// spatial splits of Stich, Friedrich and Dietrich 2009 ("Spatial Splits in Bounding Volume Hierarchies") made before the build, at planes which
/// all triangles share, as by Karras and Aila 2013 ("Fast Parallel Construction of High-Quality Bounding Volume Hierarchies"). The same on
/// any number of threads. Empty where too few triangles are worth it.
std::vector<Piece> splitPrimitives(const Geometry& geometry, double share, ThreadPool& pool);

}  // namespace minirtc
