// Boxes with rounded edges, and ice cubes: the same, half melted. With vertex normals.
#pragma once
#include "mesh.hpp"

namespace samples {

/// Centred at the origin, `fillet` the radius of edges and corners, `steps` quads along each rounded edge's arc.
Mesh roundedBox(const glm::dvec3& size, double fillet, int steps);

/// About `edge` wide; dents and bulges of a few percent.
Mesh iceCube(double edge);

}  // namespace samples
