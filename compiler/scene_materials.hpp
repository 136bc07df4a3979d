// The "materials" of a scene file.
#pragma once
#include "json_fields.hpp"
#include "scene.hpp"

namespace minirtc {

/// Appends the named materials to `scene.materials` in the order of the file, their textures to `scene.images`.
void readMaterials(SceneFile& file, const JsonValue& materials, Scene& scene);

/// The index of the material that `name`, a JSON string, names. Throws Error with the nearest known name.
uint32_t findMaterial(const SceneFile& file, const JsonValue& name, const Scene& scene);

}  // namespace minirtc
