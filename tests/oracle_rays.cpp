#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "oracle.hpp"

namespace oracle {
namespace {

/// Random numbers that are the same with every standard library.
class Random {
public:
    explicit Random(uint32_t seed) : generator_(seed) {}
    uint32_t below(size_t count) { return static_cast<uint32_t>(uint64_t{next()} * count >> 32); }
    float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }
    glm::vec3 point(const glm::vec3& lo, const glm::vec3& hi) {
        const float x = uniform(), y = uniform(), z = uniform();
        return lo + (hi - lo) * glm::vec3(x, y, z);
    }
    glm::dvec3 unitVector() {
        const double z = 1 - 2.0 * uniform(), phi = 2 * 3.14159265358979323846 * uniform(), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    uint32_t next() { return static_cast<uint32_t>(generator_()); }
    std::mt19937 generator_;
};

struct Bounds {
    glm::vec3 lo{kInfinity}, hi{-kInfinity};

    explicit Bounds(const Mesh& mesh) {
        for (const Triangle& triangle : mesh)
            for (const glm::vec3& p : triangle) lo = glm::min(lo, p), hi = glm::max(hi, p);
    }
    /// On a sphere of twice the radius of the bounds.
    glm::vec3 outside(Random& random) const {
        const glm::dvec3 l(lo), h(hi);
        return glm::vec3((l + h) * 0.5 + random.unitVector() * glm::length(h - l));
    }
};

Ray rayTowards(const glm::vec3& origin, const glm::vec3& target) {
    return {origin, 0, target - origin, kInfinity};
}

struct Less {
    bool operator()(const glm::vec3& a, const glm::vec3& b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};

struct Edge {
    glm::vec3 a, b;  // a before b
    bool operator<(const Edge& other) const {
        const Less less;
        return less(a, other.a) || (!less(other.a, a) && less(b, other.b));
    }
};

/// How many triangles have each edge, by position.
std::map<Edge, int> countEdges(const Mesh& mesh) {
    std::map<Edge, int> count;
    for (const Triangle& triangle : mesh)
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
            ++count[Less()(a, b) ? Edge{a, b} : Edge{b, a}];
        }
    return count;
}

std::vector<Edge> sharedEdges(const Mesh& mesh) {
    std::vector<Edge> edges;
    for (const auto& [edge, count] : countEdges(mesh))
        if (count == 2) edges.push_back(edge);
    return edges;
}

std::vector<glm::vec3> enclosedVertices(const Mesh& mesh) {
    std::set<glm::vec3, Less> enclosed, border;
    for (const auto& [edge, count] : countEdges(mesh))
        for (const glm::vec3& p : {edge.a, edge.b}) (count == 2 ? enclosed : border).insert(p);
    std::vector<glm::vec3> vertices;
    std::set_difference(enclosed.begin(), enclosed.end(), border.begin(), border.end(), std::back_inserter(vertices), Less());
    return vertices;
}

}  // namespace

std::vector<Ray> randomRays(const Mesh& mesh, size_t count, uint32_t seed) {
    Random random(seed);
    const Bounds bounds(mesh);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const glm::vec3 origin = bounds.outside(random);
        rays.push_back(rayTowards(origin, random.point(bounds.lo, bounds.hi)));
    }
    return rays;
}

std::vector<Ray> axisParallelRays(const Mesh& mesh, size_t count, uint32_t seed) {
    Random random(seed);
    const Bounds bounds(mesh);
    const auto vertex = [&] {
        const Triangle& triangle = mesh[random.below(mesh.size())];
        return triangle[random.below(3)];
    };
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const int along = static_cast<int>(random.below(3)), across = (along + 1) % 3;
        const float sign = random.below(2) ? 1.0f : -1.0f;
        glm::vec3 origin = vertex();
        if (random.below(2)) origin[across] = vertex()[across];
        const float size = bounds.hi[along] - bounds.lo[along];
        const float distance = std::max(size, glm::length(bounds.hi - bounds.lo)) * (0.5f + random.uniform());
        origin[along] = sign > 0 ? bounds.lo[along] - distance : bounds.hi[along] + distance;
        glm::vec3 direction(random.below(2) ? 0.0f : -0.0f);
        direction[along] = sign;
        rays.push_back({origin, 0, direction, kInfinity});
    }
    return rays;
}

std::vector<Ray> edgeRays(const Mesh& mesh, size_t count, uint32_t seed) {
    Random random(seed);
    const Bounds bounds(mesh);
    const std::vector<Edge> edges = sharedEdges(mesh);
    std::vector<Ray> rays;
    while (rays.size() < count && !edges.empty()) {
        const Edge& edge = edges[random.below(edges.size())];
        const glm::vec3 origin = bounds.outside(random);
        rays.push_back(rayTowards(origin, edge.a + (edge.b - edge.a) * random.uniform()));
    }
    return rays;
}

std::vector<Ray> vertexRays(const Mesh& mesh, size_t count, uint32_t seed) {
    Random random(seed);
    const Bounds bounds(mesh);
    const std::vector<glm::vec3> vertices = enclosedVertices(mesh);
    std::vector<Ray> rays;
    while (rays.size() < count && !vertices.empty()) {
        const glm::vec3 target = vertices[random.below(vertices.size())];
        rays.push_back(rayTowards(bounds.outside(random), target));
    }
    return rays;
}

Mesh icosphere(const glm::vec3& center, float radius, int level) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    const glm::dvec3 v[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const int f[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                          {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                          {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    std::vector<std::array<glm::dvec3, 3>> faces;
    for (const auto& i : f) faces.push_back({glm::normalize(v[i[0]]), glm::normalize(v[i[1]]), glm::normalize(v[i[2]])});
    for (; level > 0; --level) {
        std::vector<std::array<glm::dvec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    Mesh mesh;
    const auto place = [&](const glm::dvec3& p) { return glm::vec3(glm::dvec3(center) + double(radius) * p); };
    for (const auto& [a, b, c] : faces) mesh.push_back({place(a), place(b), place(c)});
    return mesh;
}

}  // namespace oracle
