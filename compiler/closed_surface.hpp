// Whether a mesh encloses a volume: every edge of a face must run the other way in another face.
#pragma once
#include "geometry.hpp"

namespace minirtc {

struct ClosedSurface {
    double size = 0;               // signed volume in m^3
    std::vector<uint32_t> shells;  // the largest triangle of each part that hangs together by edges
};

/// `triangles` make up `body`; `slivers` are those without area that belong to it: they count where the surface is not closed without
/// them. Positions are the same only where all bits are. Throws Error, which names the body and its first open edges, in world space.
ClosedSurface requireClosed(const std::vector<Primitive>& triangles, const std::vector<Primitive>& slivers, const Body& body,
                            const glm::dvec3& origin);

/// Turns round the faces of each volume whose front is inside, with their normals, and says so. An open surface has no inside: it is left alone.
Geometry turnOutward(Geometry geometry, Diagnostics& diagnostics);

}  // namespace minirtc
