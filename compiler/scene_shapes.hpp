// Shapes that a scene file gives in numbers, of objects and of lights.
#pragma once
#include "json_fields.hpp"
#include "scene.hpp"

namespace minirtc {

/// By the keys "center" and "radius".
Sphere readSphereShape(const JsonObject& object);

/// By the keys "origin", "u" and "v". `what` is for messages: "the rectangle". Throws Error where it has no area.
Rectangle readRectangleShape(const JsonObject& object, const std::string& what);

/// The key "direction": of any length but 0.
glm::dvec3 readDirection(const JsonObject& object);

}  // namespace minirtc
