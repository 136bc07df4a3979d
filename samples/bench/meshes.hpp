// What minirt-bench traces: OBJ files of a folder, or tubes along a knot with as many triangles as asked for.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "geometry.hpp"
#include "ray_sets.hpp"

namespace bench {

struct Mesh {
    std::string name;
    minirtc::Scene scene;
    minirtc::Geometry geometry;
    Triangles triangles;  // those of the geometry, in its order
};

/// All OBJ files in `folder` and below, by name. Throws std::runtime_error where there is none.
std::vector<std::filesystem::path> objFiles(const std::filesystem::path& folder);

/// `subdivisions`: times that each triangle is cut into four at the middles of its edges. Throws minirtc::Error.
Mesh loadMesh(const std::filesystem::path& path, uint32_t subdivisions = 0);

/// Of about `triangles` triangles, at least 100.
Mesh knotMesh(uint32_t triangles);

/// The same knot as a scene file with its mesh in `folder`, lit by a lamp and a sky. `integrator`: as in scene files. Throws std::runtime_error.
std::filesystem::path writeKnotScene(const std::filesystem::path& folder, uint32_t triangles, const std::string& integrator);

}  // namespace bench
