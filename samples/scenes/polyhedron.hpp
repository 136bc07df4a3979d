// Convex solids as what remains of space after cutting along planes, the way a stone is faceted.
#pragma once
#include "mesh.hpp"

namespace samples {

/// Keeps dot(normal, p) <= distance; `normal` has unit length.
struct Plane {
    glm::dvec3 normal;
    double distance;
};

/// The plane through three points that are counterclockwise seen from outside.
Plane planeThrough(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// The intersection of the half-spaces, which must be bounded: one face a plane that touches it. Points closer than
/// `tolerance` are one vertex, so planes that should meet in a point may miss it by rounding.
Mesh convexPolyhedron(const std::vector<Plane>& planes, double tolerance = 1e-7);

/// Upright prism over a regular polygon in the xz plane, centred at the origin.
Mesh prism(int sides, double edge, double height);

}  // namespace samples
