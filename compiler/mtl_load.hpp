// Wavefront .mtl material libraries.
#pragma once
#include <tiny_obj_loader.h>

#include <optional>

#include "scene.hpp"

namespace minirtc {

/// A material of a library. `values` has no name; -1 stands for Kd, Pr and Pm where the library does not give them, 2 for illum.
struct MtlMaterial {
    std::string name;
    tinyobj::material_t values;
    SourceLocation location;     // of its newmtl
    SourceLocation mapLocation;  // of its map_Kd
};

/// Reads a library. Throws Error where a number of a key that counts is no number, negative or out of range.
std::vector<MtlMaterial> readMtl(const std::filesystem::path& path);

/// The table of docs/scene_format.md. A texture that cannot be read is left out with a warning.
Material toMaterial(const MtlMaterial& mtl, Scene& scene, Diagnostics& diagnostics);

/// The file that a line of an OBJ or MTL file means: `name` beside it, with / for \, or else its last part beside it.
std::optional<std::filesystem::path> findBeside(const std::filesystem::path& folder, std::string name);

}  // namespace minirtc
