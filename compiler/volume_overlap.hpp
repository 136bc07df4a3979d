// Which space two closed surfaces share.
#pragma once
#include "surface.hpp"

namespace minirtc {

struct Solid {
    Surface surface;
    std::vector<Triangle> shells;  // a triangle of each part of a mesh that hangs together by edges; none of a sphere
};

enum class Overlap {
    none,
    partial,      // their surfaces cross, or each holds part of the other
    firstInside,  // all of the first is in the second
    secondInside,
};

/// Surfaces that touch from outside do not overlap; those that lie on each other with their fronts alike do.
Overlap overlapOf(const Solid& a, const Solid& b);

/// True where some of `thing`, which need not be closed, is in the volume, crosses its surface or lies on it. Where rounding leaves that
/// open, it is true; touching at a corner or an edge is not enough.
bool isContent(const Surface& thing, const Surface& volume);

/// True where the surface crosses itself, or where one of its shells is in another and encloses the space there once more. A shell that faces
/// inward there bounds a cavity, which is no overlap.
bool overlapsItself(const Solid& solid, unsigned threads);

/// True where a shell has its front on the inside, with nothing around it.
bool isInsideOutInPart(const Solid& solid);

/// True where two surfaces lie on each other, or so near that a ray which leaves one, offset against rounding by up to half of `distance`,
/// may pass over the other. Looks at flat faces, and at two spheres.
bool lieOnEachOther(const Surface& a, const Surface& b, double distance);

}  // namespace minirtc
