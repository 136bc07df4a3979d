// Closed meshes to shoot rays at.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <vector>

namespace test {

struct ClosedMesh {
    std::vector<glm::dvec3> positions;
    std::vector<std::array<uint32_t, 3>> faces;  // counter-clockwise from outside
};

/// The octahedron, each face cut into four `levels` times, on the unit sphere: convex.
inline ClosedMesh ball(int levels) {
    ClosedMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.positions.size()));
            if (isNew) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
            return found->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.faces) {
            const uint32_t ab = middle(a, b);
            const uint32_t bc = middle(b, c);
            const uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.faces = finer;
    }
    return mesh;
}

/// A ring about the y axis: not convex.
inline ClosedMesh torus(uint32_t around, uint32_t across) {
    ClosedMesh mesh;
    constexpr double kTurn = 6.283185307179586;
    for (uint32_t i = 0; i < around; ++i) {
        for (uint32_t k = 0; k < across; ++k) {
            const double u = kTurn * i / around;
            const double v = kTurn * k / across;
            const double r = 0.7 + 0.3 * std::cos(v);
            mesh.positions.push_back({r * std::cos(u), 0.3 * std::sin(v), r * std::sin(u)});
            const auto at = [&](uint32_t a, uint32_t b) { return a % around * across + b % across; };
            mesh.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
            mesh.faces.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
        }
    }
    return mesh;
}

/// Its triangles in float, scaled and moved.
inline std::vector<std::array<glm::vec3, 3>> placed(const ClosedMesh& mesh, const glm::dvec3& scale, const glm::dvec3& offset) {
    std::vector<std::array<glm::vec3, 3>> triangles;
    for (const auto& face : mesh.faces) {
        std::array<glm::vec3, 3> triangle;
        for (int i = 0; i < 3; ++i) triangle[i] = glm::vec3(mesh.positions[face[i]] * scale + offset);
        triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace test
