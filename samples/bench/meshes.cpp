#include "meshes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "knot.hpp"
#include "output.hpp"

namespace bench {
namespace {

Mesh flattened(const std::string& name, minirtc::Scene scene, minirtc::Mesh mesh) {
    minirtc::Object object;
    object.name = name;
    object.mesh = 0;
    object.material = 0;
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(object);
    scene.materials.resize(1);
    minirtc::Diagnostics diagnostics;
    Mesh result{name, std::move(scene), {}, {}};
    result.geometry = minirtc::flatten(result.scene, diagnostics);
    for (const minirtc::Primitive& primitive : result.geometry.primitives) result.triangles.push_back(primitive.p);
    return result;
}

/// Each triangle as four that meet at the middles of its edges.
minirtc::Mesh subdivided(const minirtc::Mesh& mesh) {
    minirtc::Mesh fine;
    fine.path = mesh.path;
    fine.positions = mesh.positions;
    fine.faces.reserve(4 * mesh.faces.size());
    for (const minirtc::Face& face : mesh.faces) {
        const auto corner = [&](int k) { return face.corners[k % 3].position; };
        const uint32_t middle = static_cast<uint32_t>(fine.positions.size());
        for (int k = 0; k < 3; ++k) fine.positions.push_back(0.5 * (mesh.positions[corner(k)] + mesh.positions[corner(k + 1)]));
        const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
            minirtc::Face triangle;
            triangle.corners[0].position = a, triangle.corners[1].position = b, triangle.corners[2].position = c;
            fine.faces.push_back(triangle);
        };
        for (uint32_t k = 0; k < 3; ++k) add(corner(static_cast<int>(k)), middle + k, middle + (k + 2) % 3);
        add(middle, middle + 1, middle + 2);
    }
    return fine;
}

samples::Mesh knotOf(uint32_t triangles) {
    samples::TorusKnot shape;
    shape.sides = std::max(5, static_cast<int>(std::sqrt(triangles * 0.05625)));  // the sample's own proportions
    shape.segments = std::max(10, static_cast<int>(triangles) / (2 * shape.sides));
    return samples::torusKnot(shape);
}

}  // namespace

std::vector<std::filesystem::path> objFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".obj") files.push_back(entry.path());
    if (files.empty()) throw std::runtime_error(folder.string() + ": no OBJ file in it");
    std::sort(files.begin(), files.end());
    return files;
}

Mesh loadMesh(const std::filesystem::path& path, uint32_t subdivisions) {
    minirtc::Scene scene;
    minirtc::Diagnostics diagnostics;
    minirtc::Mesh mesh = minirtc::loadObj(path, false, scene, diagnostics);
    for (uint32_t i = 0; i < subdivisions; ++i) mesh = subdivided(mesh);
    const std::string suffix = subdivisions > 0 ? " / " + std::to_string(subdivisions) : "";
    return flattened(path.stem().string() + suffix, std::move(scene), std::move(mesh));
}

Mesh knotMesh(uint32_t triangles) {
    const samples::Mesh knot = knotOf(triangles);
    minirtc::Mesh mesh;
    mesh.path = "knot";
    mesh.positions = knot.positions;
    for (const samples::Face& face : knot.faces)
        for (size_t i = 2; i < face.size(); ++i) {
            minirtc::Face triangle;
            const size_t corners[3] = {0, i - 1, i};
            for (int k = 0; k < 3; ++k) triangle.corners[k].position = face[corners[k]].position;
            mesh.faces.push_back(triangle);
        }
    return flattened("knot", {}, std::move(mesh));
}

std::filesystem::path writeKnotScene(const std::filesystem::path& folder, uint32_t triangles, const std::string& integrator) {
    samples::writeObj(knotOf(triangles), folder / "knot.obj");
    std::filesystem::path scene = folder / ("knot_" + integrator + ".json");
    samples::writeText(scene, R"({"camera": {"position": [0, 3, 4], "target": [0, 0, 0], "vfov": 40},
 "background": {"color": [0.3, 0.4, 0.5]},
 "lights": [{"type": "directional", "direction": [-1, -2, -1], "irradiance": [2, 2, 2]}],
 "materials": {"clay": {"model": "pbr", "baseColor": [0.8, 0.7, 0.6], "metallic": 0, "roughness": 0.6}},
 "objects": [{"mesh": "knot.obj", "material": "clay"}],
 "render": {"size": [640, 480], "integrator": ")" +
                                  integrator + "\"}}\n");
    return scene;
}

}  // namespace bench
