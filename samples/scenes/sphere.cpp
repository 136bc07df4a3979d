#include "sphere.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace samples {
namespace {

Mesh icosahedron() {
    const double phi = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh;
    mesh.positions = {{-1, phi, 0},  {1, phi, 0},  {-1, -phi, 0}, {1, -phi, 0}, {0, -1, phi},  {0, 1, phi},
                      {0, -1, -phi}, {0, 1, -phi}, {phi, 0, -1},  {phi, 0, 1},  {-phi, 0, -1}, {-phi, 0, 1}};
    for (glm::dvec3& p : mesh.positions) p = glm::normalize(p);
    const uint32_t faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (const auto& face : faces) mesh.faces.push_back(makeFace({face[0], face[1], face[2]}));
    return mesh;
}

Mesh split(const Mesh& coarse) {
    Mesh fine;
    fine.positions = coarse.positions;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [entry, isNew] =
            middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(fine.positions.size()));
        if (isNew) fine.positions.push_back(glm::normalize(fine.positions[a] + fine.positions[b]));
        return entry->second;
    };
    for (const Face& face : coarse.faces) {
        const uint32_t a = face[0].position;
        const uint32_t b = face[1].position;
        const uint32_t c = face[2].position;
        const uint32_t ab = middle(a, b);
        const uint32_t bc = middle(b, c);
        const uint32_t ca = middle(c, a);
        fine.faces.push_back(makeFace({a, ab, ca}));
        fine.faces.push_back(makeFace({ab, b, bc}));
        fine.faces.push_back(makeFace({ca, bc, c}));
        fine.faces.push_back(makeFace({ab, bc, ca}));
    }
    return fine;
}

}  // namespace

Mesh icosphere(int levels) {
    Mesh mesh = icosahedron();
    for (int level = 0; level < levels; ++level) mesh = split(mesh);
    mesh.normals = mesh.positions;
    for (Face& face : mesh.faces) {
        for (Corner& corner : face) corner.normal = corner.position;
    }
    return mesh;
}

Mesh pebble(int levels) {
    Mesh mesh = icosphere(levels);
    for (glm::dvec3& p : mesh.positions) {
        const double bulges = std::sin(3.1 * p.x + 1.3) * std::sin(2.7 * p.y + 0.4) +
                              std::sin(3.7 * p.z + 2.1 * p.x - 0.8) * 0.6 + std::sin(5.3 * p.y - 2.9 * p.z) * 0.25;
        p *= 1 + 0.16 * bulges;
    }
    addNormals(mesh, 180);
    return mesh;
}

}  // namespace samples
