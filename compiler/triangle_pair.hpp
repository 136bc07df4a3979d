// How two triangles lie to each other: in double, on float positions, with a bound of the rounding of every sign.
#pragma once
#include <array>
#include <glm/glm.hpp>

namespace minirtc {

using Triangle = std::array<glm::dvec3, 3>;

enum class Meeting {
    apart,
    grazing,      // not more than corners of one in the plane of the other, as far as double can tell
    touching,     // at an edge: the surfaces that they belong to may cross there or not
    crossing,     // an edge of one goes through the inside of the other
    sameFront,    // in one plane, with the same front side; they share area
    frontToFront  // in one plane, with opposite front sides; they share area
};

struct Contact {
    Meeting meeting = Meeting::apart;
    glm::dvec3 point{0};  // where they touch
};

/// Along the normal; its length is twice the area.
glm::dvec3 areaVector(const Triangle& triangle);

/// Neighbours in a mesh that share an edge or a corner and do no more are not crossing.
Contact meet(const Triangle& a, const Triangle& b);

/// True where one lies within `distance` of the plane of the other, and they share an area wider than that, seen along the normal.
bool lieOnEachOther(const Triangle& a, const Triangle& b, double distance);

/// The distances from a point to the nearest and the farthest point of a triangle.
struct DistanceRange {
    double nearest, farthest;
};
DistanceRange distances(const glm::dvec3& point, const Triangle& triangle);

}  // namespace minirtc
