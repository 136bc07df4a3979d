// Solids of revolution about +Y, and the profiles they are turned from.
#pragma once
#include "mesh.hpp"

namespace samples {

/// Points (radius, y). A profile starts and ends on the axis and keeps the solid on its left, so it runs from the lower pole
/// outward and up.
using Profile = std::vector<glm::dvec2>;

/// A corner of a profile, rounded with radius `fillet`.
struct ProfileCorner {
    double r;
    double y;
    double fillet = 0;
};

/// Straight lines between the corners, arcs of at most 10 degrees a step where they are rounded.
Profile rounded(const std::vector<ProfileCorner>& corners);

/// Catmull-Rom spline through the points, `steps` pieces a span.
Profile spline(const Profile& points, int steps);

/// With pieces no longer than `longest`.
Profile subdivided(const Profile& profile, double longest);

/// Turns the profile in `segments` steps. Texture coordinates: u once around to the right seen from outside, v in [0,1] along
/// the profile. No normals yet (addNormals).
Mesh lathe(const Profile& profile, int segments);

}  // namespace samples
