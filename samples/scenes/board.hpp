// Table tops.
#pragma once
#include "mesh.hpp"

namespace samples {

/// A slab with rounded edges, its top at y = 0. Texture coordinates from above: u along x, v along -z, [0,1] over the size.
Mesh board(const glm::dvec3& size, double fillet);

}  // namespace samples
