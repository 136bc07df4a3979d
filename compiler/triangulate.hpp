// Polygons into triangles.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace minirtc {

using TriangleIndices = std::array<uint32_t, 3>;

/// Splits a simple polygon, convex or concave, flat or nearly so, into `size - 2` triangles of its corners' indices with its
/// orientation. A quad is cut along its shorter inner diagonal; the rest by ears (Meisters 1975), so that collinear corners
/// stay corners and leave no cracks. A polygon that crosses itself or has no area comes out as some triangles, never as none.
/// False, and nothing added, for a concave polygon of over 4096 corners: ears take up to cubic time.
bool triangulate(const std::vector<glm::dvec3>& polygon, std::vector<TriangleIndices>& triangles);

}  // namespace minirtc
