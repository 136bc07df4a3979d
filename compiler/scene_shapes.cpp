#include "scene_shapes.hpp"

namespace minirtc {

Sphere readSphereShape(const JsonObject& object) {
    Sphere sphere;
    sphere.center = object.vector("center", sphere.center);
    sphere.radius = object.number("radius", sphere.radius, kPositive);
    return sphere;
}

Rectangle readRectangleShape(const JsonObject& object, const std::string& what) {
    Rectangle rectangle;
    rectangle.origin = object.vector("origin", rectangle.origin);
    object.require("u");
    object.require("v");
    rectangle.u = object.vector("u", {});
    rectangle.v = object.vector("v", {});
    const double u = glm::length(rectangle.u), v = glm::length(rectangle.v);
    const double area = glm::length(glm::cross(rectangle.u, rectangle.v));
    constexpr double kThinnest = 1e-7;  // sine of the angle between u and v: thinner is a line in single precision
    if (!(area > kThinnest * u * v)) object.fail("", what + " has no area", "'u' and 'v' must differ in direction");
    return rectangle;
}

glm::dvec3 readDirection(const JsonObject& object) {
    object.require("direction");
    const glm::dvec3 direction = object.vector("direction", {});
    if (glm::length(direction) == 0) object.fail("direction", "'direction' has no length", "give the way the light travels");
    return direction;
}

}  // namespace minirtc
