// Wavefront .mtl material libraries.
#pragma once
#include <optional>

#include "scene.hpp"

namespace minirtc {

/// What a library says of one material; a key that it does not give is empty.
struct MtlMaterial {
    std::string name;
    SourceLocation location;  // of its newmtl
    std::optional<glm::dvec3> Kd, Ks, Tf, Ke;
    std::optional<double> Ns, Ni, d, Pr, Pm;
    std::optional<int> illum;
    std::string mapKd;  // path as written
    SourceLocation mapLocation;
};

/// Reads a library. Throws Error where a number of a key that counts is no number, negative or out of range.
std::vector<MtlMaterial> readMtl(const std::filesystem::path& path, Diagnostics& diagnostics);

/// The table of docs/scene_format.md. A texture that cannot be read is left out with a warning.
Material toMaterial(const MtlMaterial& mtl, Scene& scene, Diagnostics& diagnostics);

/// The file that a line of an OBJ or MTL file means: `name` beside it, with / for \, or else its last part beside it.
std::optional<std::filesystem::path> findBeside(const std::filesystem::path& folder, std::string name);

}  // namespace minirtc
