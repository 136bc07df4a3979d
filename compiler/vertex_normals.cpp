#include "vertex_normals.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace minirtc {
namespace {

/// Numbers equal positions alike, from 0 on in order of first appearance: open addressing, linear probing.
std::vector<uint32_t> weld(const std::vector<glm::vec3>& positions, uint32_t& count) {
    size_t slots = 16;
    while (slots < 2 * positions.size()) slots *= 2;
    std::vector<uint32_t> table(slots, kNone);  // a position that has the slot's value
    std::vector<uint32_t> vertex(positions.size());
    count = 0;
    for (uint32_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 key = positions[i] + 0.0f;  // -0 becomes 0
        uint32_t bits[3];
        std::memcpy(bits, &key, sizeof bits);
        uint64_t hash = 0;
        for (const uint32_t word : bits) hash = (hash ^ word) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
        size_t slot = hash & (slots - 1);
        while (table[slot] != kNone && positions[table[slot]] != key) slot = (slot + 1) & (slots - 1);
        if (table[slot] == kNone)
            table[slot] = i, vertex[i] = count++;
        else
            vertex[i] = vertex[table[slot]];
    }
    return vertex;
}

/// atan2 is exact for needles too, where acos of a rounded cosine is not.
double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

VertexNormals averageNormals(const Mesh& mesh, const std::vector<glm::dvec3>& points, const std::vector<glm::vec3>& rounded) {
    uint32_t count = 0;
    std::vector<uint32_t> vertex = weld(rounded, count);
    std::vector<glm::dvec3> sums(count, glm::dvec3(0));
    for (const Face& face : mesh.faces) {
        glm::dvec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = points[face.corners[i].position];
        const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(area);
        // Thinner than this the direction is noise, and at a needle's blunt corner it would weigh as much as half a disc.
        constexpr double kThinnest = 1e-7;
        const double longest = std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
        if (!(length > kThinnest * longest * longest)) continue;
        for (int i = 0; i < 3; ++i) {
            const double angle = angleBetween(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            sums[vertex[face.corners[i].position]] += area / length * angle;
        }
    }
    constexpr double kCancelled = 1e-9;
    for (glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        sum = length > kCancelled ? sum / length : glm::dvec3(0);
    }
    return VertexNormals(std::move(vertex), std::move(sums));
}

}  // namespace minirtc
