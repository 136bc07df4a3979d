#include "knot.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace samples {
namespace {

struct Frame {
    glm::dvec3 origin;
    glm::dvec3 normal;  // out of the torus that carries the knot, so it closes without a twist
    glm::dvec3 binormal;
};

Frame frameAt(const TorusKnot& knot, double turn) {
    const double ring = knot.p * turn;
    const double winding = knot.q * turn;
    const glm::dvec3 outward{std::cos(ring), 0, std::sin(ring)};
    const glm::dvec3 normal = outward * std::cos(winding) + glm::dvec3{0, std::sin(winding), 0};
    const glm::dvec3 alongRing{-std::sin(ring), 0, std::cos(ring)};
    const glm::dvec3 alongWinding = -outward * std::sin(winding) + glm::dvec3{0, std::cos(winding), 0};
    const double distance = knot.ringRadius + knot.windingRadius * std::cos(winding);
    const glm::dvec3 tangent = glm::normalize(alongRing * (knot.p * distance) + alongWinding * (knot.q * knot.windingRadius));
    return {outward * knot.ringRadius + normal * knot.windingRadius, normal, glm::cross(tangent, normal)};
}

}  // namespace

Mesh torusKnot(const TorusKnot& knot) {
    Mesh mesh;
    for (int s = 0; s < knot.segments; ++s) {
        const Frame frame = frameAt(knot, glm::two_pi<double>() * s / knot.segments);
        for (int i = 0; i < knot.sides; ++i) {
            const double angle = glm::two_pi<double>() * i / knot.sides;
            const glm::dvec3 normal = frame.normal * std::cos(angle) + frame.binormal * std::sin(angle);
            mesh.positions.push_back(frame.origin + normal * knot.tubeRadius);
        }
    }
    const auto at = [&](int s, int i) { return static_cast<uint32_t>(s % knot.segments * knot.sides + i % knot.sides); };
    for (int s = 0; s < knot.segments; ++s) {
        for (int i = 0; i < knot.sides; ++i)
            mesh.faces.push_back(makeFace({at(s, i), at(s, i + 1), at(s + 1, i + 1), at(s + 1, i)}));
    }
    addNormals(mesh, 180);
    return mesh;
}

}  // namespace samples
