// Closed shapes over grids: leaves, fins, slabs with a relief.
#pragma once
#include <functional>

#include "mesh.hpp"

namespace samples {

/// What a leaf is at (u, v) in [0,1]^2: a point midway between its two sides, and from there to the front.
struct LeafPoint {
    glm::dvec3 middle;
    glm::dvec3 half;
};

/// Two sheets of `nu` x `nv` quads that meet in a sharp edge all around, where `half` does not count.
Mesh leaf(int nu, int nv, const std::function<LeafPoint(double, double)>& at);

/// A slab over the rectangle |x| <= halfWidth, |z| <= halfDepth from y = `bottom` up to height(x, z).
Mesh relief(double halfWidth, double halfDepth, double bottom, int nx, int nz,
            const std::function<double(double, double)>& height);

/// Adds a copy of `part`, which has no normals, to `whole`.
void append(Mesh& whole, const Mesh& part);

}  // namespace samples
