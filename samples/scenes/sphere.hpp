// Geodesic spheres, and smooth shapes made by moving their vertices. With vertex normals.
#pragma once
#include "mesh.hpp"

namespace samples {

/// Unit sphere: an icosahedron, each face split into 4 `levels` times (20 * 4^levels triangles).
Mesh icosphere(int levels);

/// A pebble of mean radius 1 with soft bulges.
Mesh pebble(int levels);

}  // namespace samples
