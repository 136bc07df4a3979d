// The "lights" of a scene file.
#pragma once
#include "json_fields.hpp"
#include "scene.hpp"

namespace minirtc {

/// Appends lights without size to `scene.lights`. Those that have one are returned as objects, and their materials appended to
/// `scene.materials`.
std::vector<Object> readLights(SceneFile& file, const JsonValue& lights, Scene& scene);

}  // namespace minirtc
