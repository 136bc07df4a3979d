#include "polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace samples {
namespace {

bool keeps(const std::vector<Plane>& planes, const glm::dvec3& p, double tolerance) {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return glm::dot(plane.normal, p) <= plane.distance + tolerance; });
}

bool contains(const std::vector<glm::dvec3>& points, const glm::dvec3& p, double tolerance) {
    return std::any_of(points.begin(), points.end(), [&](const glm::dvec3& q) { return glm::distance(p, q) < tolerance; });
}

/// All corners of the solid: the points where three planes meet and no other cuts them off.
std::vector<glm::dvec3> corners(const std::vector<Plane>& planes, double tolerance) {
    std::vector<glm::dvec3> points;
    for (size_t i = 0; i < planes.size(); ++i) {
        for (size_t j = i + 1; j < planes.size(); ++j) {
            const glm::dvec3 line = glm::cross(planes[i].normal, planes[j].normal);
            for (size_t k = j + 1; k < planes.size(); ++k) {
                const double determinant = glm::dot(line, planes[k].normal);
                if (std::abs(determinant) < 1e-9) continue;
                const glm::dvec3 p =
                    (planes[i].distance * glm::cross(planes[j].normal, planes[k].normal) +
                     planes[j].distance * glm::cross(planes[k].normal, planes[i].normal) + planes[k].distance * line) /
                    determinant;
                if (keeps(planes, p, tolerance) && !contains(points, p, 10 * tolerance)) points.push_back(p);
            }
        }
    }
    return points;
}

/// The vertices on `plane`, counterclockwise about its normal.
Face facet(const std::vector<glm::dvec3>& points, const Plane& plane, double tolerance) {
    std::vector<uint32_t> on;
    glm::dvec3 centre{0};
    for (uint32_t i = 0; i < points.size(); ++i) {
        if (std::abs(glm::dot(plane.normal, points[i]) - plane.distance) > 10 * tolerance) continue;
        on.push_back(i);
        centre += points[i];
    }
    if (on.size() < 3) return {};
    centre /= static_cast<double>(on.size());
    const glm::dvec3 x = glm::normalize(points[on[0]] - centre);
    const glm::dvec3 y = glm::cross(plane.normal, x);
    const auto angle = [&](uint32_t i) { return std::atan2(glm::dot(y, points[i] - centre), glm::dot(x, points[i] - centre)); };
    std::sort(on.begin(), on.end(), [&](uint32_t a, uint32_t b) { return angle(a) < angle(b); });
    return makeFace(on);
}

}  // namespace

Plane planeThrough(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    return {normal, glm::dot(normal, a)};
}

Mesh convexPolyhedron(const std::vector<Plane>& planes, double tolerance) {
    Mesh mesh;
    mesh.positions = corners(planes, tolerance);
    for (const Plane& plane : planes) {
        const Face face = facet(mesh.positions, plane, tolerance);
        if (!face.empty()) mesh.faces.push_back(face);
    }
    return mesh;
}

Mesh prism(int sides, double edge, double height) {
    std::vector<Plane> planes{{{0, 1, 0}, height / 2}, {{0, -1, 0}, height / 2}};
    const double apothem = edge / (2 * std::tan(glm::pi<double>() / sides));
    for (int i = 0; i < sides; ++i) {
        const double azimuth = glm::two_pi<double>() * i / sides;
        planes.push_back({{std::cos(azimuth), 0, std::sin(azimuth)}, apothem});
    }
    return convexPolyhedron(planes);
}

}  // namespace samples
