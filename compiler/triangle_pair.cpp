#include "triangle_pair.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

/// Over the rounding of a determinant of differences of floats, relative to the sum of the sizes of its terms (Shewchuk 1997).
constexpr double kRounding = 2e-15;

/// Through three points; `side` is 1 before it (where it is seen counter-clockwise), -1 behind, 0 where rounding cannot tell.
class Plane {
public:
    Plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) : a_(a) {
        const glm::dvec3 u = b - a, v = c - a;
        const glm::dvec3 x(u.y * v.z, u.z * v.x, u.x * v.y), y(u.z * v.y, u.x * v.z, u.y * v.x);
        n_ = x - y;
        error_ = kRounding * (glm::abs(x) + glm::abs(y));
    }
    explicit Plane(const Triangle& t) : Plane(t[0], t[1], t[2]) {}

    int side(const glm::dvec3& p) const {
        const glm::dvec3 d = p - a_;
        const double height = glm::dot(n_, d);
        const double error = glm::dot(error_, glm::abs(d));
        return height > error ? 1 : height < -error ? -1 : 0;
    }
    std::array<int, 3> sides(const Triangle& t) const { return {side(t[0]), side(t[1]), side(t[2])}; }
    const glm::dvec3& normal() const { return n_; }

private:
    glm::dvec3 a_, n_, error_;
};

bool allOf(const std::array<int, 3>& sides, int side) {
    return sides[0] == side && sides[1] == side && sides[2] == side;
}

bool hasZero(const std::array<int, 3>& sides) {
    return sides[0] == 0 || sides[1] == 0 || sides[2] == 0;
}

/// The edge from p to q, whose ends are on different sides of the triangle's plane, against the triangle.
Meeting pierce(const glm::dvec3& p, const glm::dvec3& q, const Triangle& t) {
    int least = 1, most = -1;
    for (int i = 0; i < 3; ++i) {
        const int side = Plane(p, q, t[i]).side(t[(i + 1) % 3]);
        least = std::min(least, side), most = std::max(most, side);
    }
    if (least < 0 && most > 0) return Meeting::apart;
    return least == most && least != 0 ? Meeting::crossing : Meeting::touching;
}

/// Where the line meets the plane.
glm::dvec3 pointOnPlane(const glm::dvec3& p, const glm::dvec3& q, const Triangle& t, const glm::dvec3& n) {
    const double a = glm::dot(n, p - t[0]), b = glm::dot(n, q - t[0]);
    return p + (q - p) * (a / (a - b));
}

/// The edges of `t`, on these sides of the other's plane.
Contact pierceEdges(const Triangle& t, const std::array<int, 3>& sides, const Triangle& other, const Plane& plane) {
    Contact contact;
    for (int i = 0; i < 3; ++i) {
        const int k = (i + 1) % 3;
        if (sides[i] * sides[k] >= 0) continue;
        const Meeting meeting = pierce(t[i], t[k], other);
        if (meeting == Meeting::crossing) return {meeting, {}};
        if (meeting == Meeting::touching) contact = {meeting, pointOnPlane(t[i], t[k], other, plane.normal())};
    }
    return contact;
}

using Flat = std::array<glm::dvec2, 3>;

/// Along the axis where `n` is longest; counter-clockwise when `t` is so seen along n.
Flat project(const Triangle& t, const glm::dvec3& n) {
    const glm::dvec3 size = glm::abs(n);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    Flat flat;
    for (int i = 0; i < 3; ++i) flat[i] = n[axis] > 0 ? glm::dvec2(t[i][x], t[i][y]) : glm::dvec2(t[i][y], t[i][x]);
    return flat;
}

/// True where an edge of `a` (counter-clockwise) has all of `b` outside, or in by no more than `margin`.
bool separates(const Flat& a, const Flat& b, double margin) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 edge = a[(i + 1) % 3] - a[i];
        const double length = glm::length(edge);
        double inmost = -1e300;
        for (const glm::dvec2& p : b) inmost = std::max(inmost, edge.x * (p.y - a[i].y) - edge.y * (p.x - a[i].x));
        if (inmost <= margin * length) return true;
    }
    return false;
}

/// True where the projections along n share an area wider than `margin`.
bool shareArea(const Triangle& a, const Triangle& b, const glm::dvec3& n, double margin) {
    Flat flatA = project(a, n), flatB = project(b, n);
    if (glm::dot(n, areaVector(b)) < 0) std::swap(flatB[1], flatB[2]);
    return !separates(flatA, flatB, margin) && !separates(flatB, flatA, margin);
}

double longestEdge(const Triangle& t) {
    return std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
}

bool isWithin(const Triangle& t, const glm::dvec3& onPlane, const glm::dvec3& unitNormal, double distance) {
    return std::all_of(t.begin(), t.end(),
                       [&](const glm::dvec3& p) { return std::fabs(glm::dot(p - onPlane, unitNormal)) <= distance; });
}

glm::dvec3 nearestOnEdge(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a;
    return a + edge * glm::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
}

}  // namespace

glm::dvec3 areaVector(const Triangle& triangle) {
    return glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

Contact meet(const Triangle& a, const Triangle& b) {
    const Plane planeA(a);
    const std::array<int, 3> sidesB = planeA.sides(b);
    if (allOf(sidesB, 1) || allOf(sidesB, -1)) return {};
    const Plane planeB(b);
    const std::array<int, 3> sidesA = planeB.sides(a);
    if (allOf(sidesA, 1) || allOf(sidesA, -1)) return {};
    if (allOf(sidesA, 0) && allOf(sidesB, 0)) {
        if (!shareArea(a, b, planeA.normal(), 1e-12 * std::min(longestEdge(a), longestEdge(b)))) return {Meeting::grazing, {}};
        const bool same = glm::dot(planeA.normal(), planeB.normal()) > 0;
        return {same ? Meeting::sameFront : Meeting::frontToFront, {}};
    }
    const Contact first = pierceEdges(b, sidesB, a, planeA);
    if (first.meeting == Meeting::crossing) return first;
    const Contact second = pierceEdges(a, sidesA, b, planeB);
    const Contact contact = second.meeting == Meeting::apart ? first : second;
    if (contact.meeting == Meeting::apart && (hasZero(sidesA) || hasZero(sidesB))) return {Meeting::grazing, {}};
    return contact;
}

bool lieOnEachOther(const Triangle& a, const Triangle& b, double distance) {
    const glm::dvec3 na = glm::normalize(areaVector(a)), nb = glm::normalize(areaVector(b));
    constexpr double kParallel = 0.9;  // saves what follows; the distances decide
    if (std::fabs(glm::dot(na, nb)) < kParallel) return false;
    if (!isWithin(b, a[0], na, distance) && !isWithin(a, b[0], nb, distance)) return false;
    return shareArea(a, b, na, distance);
}

DistanceRange distances(const glm::dvec3& point, const Triangle& t) {
    DistanceRange range = {1e300, 0};
    const glm::dvec3 n = areaVector(t);
    bool above = true;  // the foot of the perpendicular is in the triangle
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
        range.nearest = std::min(range.nearest, glm::length(point - nearestOnEdge(point, a, b)));
        range.farthest = std::max(range.farthest, glm::length(point - a));
        above = above && glm::dot(glm::cross(b - a, point - a), n) >= 0;
    }
    if (above) range.nearest = std::fabs(glm::dot(point - t[0], n)) / glm::length(n);
    return range;
}

}  // namespace minirtc
