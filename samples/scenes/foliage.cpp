#include "foliage.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "noise.hpp"
#include "sheet.hpp"

namespace samples {
namespace {

constexpr double kGoldenAngle = 2.39996323;

/// A branch as points along its bend.
struct Branch {
    std::vector<glm::dvec3> points;
    double radius;  // at its base; at the tip a third of it
    int level;      // 0: the stem
    int number;     // seeds what is random about it

    glm::dvec3 at(double t) const {
        const double place = t * static_cast<double>(points.size() - 1);
        const size_t i = std::min(static_cast<size_t>(place), points.size() - 2);
        return glm::mix(points[i], points[i + 1], place - static_cast<double>(i));
    }
    glm::dvec3 directionAt(double t) const { return glm::normalize(at(std::min(1.0, t + 0.1)) - at(std::max(0.0, t - 0.1))); }
    double radiusAt(double t) const { return radius * (1 - 0.67 * t); }
};

/// Bends towards the light on its way.
Branch branch(const glm::dvec3& base, glm::dvec3 direction, double length, double radius, int level, int number) {
    constexpr int kPieces = 5;
    Branch result{{base}, radius, level, number};
    for (int i = 0; i < kPieces; ++i) {
        result.points.push_back(result.points.back() + direction * (length / kPieces));
        const auto random = [&](int k) { return lattice({number, i, k}) - 0.5; };
        direction = glm::normalize(direction + glm::dvec3{0.35 * random(0), 0.10 + 0.2 * random(1), 0.35 * random(2)});
    }
    return result;
}

void addBranches(std::vector<Branch>& all, const Branch& parent) {
    constexpr int kChildren[] = {13, 10};
    constexpr double kLengths[] = {0.62, 0.30};
    if (parent.level == 2) return;
    const int count = kChildren[parent.level];
    for (int i = 0; i < count; ++i) {
        const double t = glm::mix(0.28, 1.0, (i + 0.5) / count);
        const glm::dvec3 ahead = parent.directionAt(t);
        const glm::dvec3 side = glm::normalize(glm::cross(ahead, glm::dvec3(0.31, 0.2, 0.93)));
        const double turn = kGoldenAngle * i + parent.number;
        const glm::dvec3 away = side * std::cos(turn) + glm::cross(ahead, side) * std::sin(turn);
        const int number = 31 * parent.number + i + 1;
        const double length = kLengths[parent.level] * (0.75 + 0.5 * lattice({number, 7, 7})) * (1.15 - 0.5 * t);
        all.push_back(branch(parent.at(t), glm::normalize(0.62 * ahead + away), length, 0.55 * parent.radiusAt(t),
                             parent.level + 1, number));
        addBranches(all, Branch(all.back()));
    }
}

std::vector<Branch> branches() {
    std::vector<Branch> all{branch({0, -0.02, 0}, glm::normalize(glm::dvec3(0.08, 1, 0.02)), 1.05, 0.032, 0, 1)};
    addBranches(all, Branch(all.front()));
    return all;
}

/// A tapered tube with pointed ends.
Mesh tube(const Branch& branch) {
    constexpr uint32_t kSides = 7;
    Mesh mesh;
    mesh.positions.push_back(branch.points.front());
    const auto rings = static_cast<uint32_t>(branch.points.size());
    for (uint32_t r = 0; r < rings; ++r) {
        const double t = static_cast<double>(r) / (rings - 1);
        const glm::dvec3 ahead = branch.directionAt(t);
        const glm::dvec3 side = glm::normalize(glm::cross(ahead, glm::dvec3(0.31, 0.2, 0.93)));
        for (uint32_t i = 0; i < kSides; ++i) {
            const double angle = glm::two_pi<double>() * i / kSides;
            const glm::dvec3 out = side * std::cos(angle) + glm::cross(ahead, side) * std::sin(angle);
            mesh.positions.push_back(branch.points[r] + branch.radiusAt(t) * (out + (r == 0           ? 0.3
                                                                                     : r + 1 == rings ? -0.3
                                                                                                      : 0) *
                                                                                        ahead));
        }
    }
    mesh.positions.push_back(branch.points.back());
    const auto at = [&](uint32_t r, uint32_t i) { return 1 + r * kSides + i % kSides; };
    for (uint32_t i = 0; i < kSides; ++i) {
        mesh.faces.push_back(makeFace({0, at(0, i + 1), at(0, i)}));
        for (uint32_t r = 0; r + 1 < rings; ++r)
            mesh.faces.push_back(makeFace({at(r, i), at(r, i + 1), at(r + 1, i + 1), at(r + 1, i)}));
        mesh.faces.push_back(makeFace({at(rings - 1, i), at(rings - 1, i + 1), 1 + rings * kSides}));
    }
    return mesh;
}

/// Quads along `points`, `half` to either side; the first at v = 0, the last at v = 1.
void addCard(Mesh& mesh, const std::vector<glm::dvec3>& points, const glm::dvec3& half) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (size_t i = 0; i < points.size(); ++i) {
        const double v = static_cast<double>(i) / static_cast<double>(points.size() - 1);
        for (const double side : {-1.0, 1.0}) {
            mesh.positions.push_back(points[i] + side * half);
            mesh.uvs.push_back({0.5 + 0.5 * side, v});
        }
    }
    for (uint32_t i = 0; i + 1 < points.size(); ++i) {
        Face face;
        for (const uint32_t corner : {0u, 1u, 3u, 2u}) face.push_back({first + 2 * i + corner, kNone, first + 2 * i + corner});
        mesh.faces.push_back(face);
    }
}

/// A leafy twig that grows from `base` and hangs over towards its tip.
void addLeaf(Mesh& mesh, const glm::dvec3& base, const glm::dvec3& direction, double size) {
    const glm::dvec3 down{0, -0.35 * size, 0};
    const glm::dvec3 middle = base + 0.5 * size * direction, tip = base + size * direction + down;
    addCard(mesh, {base, middle, tip}, 0.5 * size * glm::normalize(glm::cross(direction, glm::dvec3(0, 1, 0))));
}

double uniform(int number, int k) {
    return lattice({number, 101, k});
}

}  // namespace

Mesh shrubStems() {
    Mesh mesh;
    for (const Branch& branch : branches()) append(mesh, tube(branch));
    addNormals(mesh, 60);
    return mesh;
}

Mesh shrubLeaves() {
    Mesh mesh;
    for (const Branch& branch : branches()) {
        const int count = branch.level == 2 ? 6 : branch.level == 1 ? 4 : 0;
        for (int i = 0; i < count; ++i) {
            const double t = glm::mix(0.35, 1.0, (i + 1.0) / count);
            const glm::dvec3 ahead = branch.directionAt(t);
            const double turn = kGoldenAngle * i + branch.number;
            const glm::dvec3 away{std::cos(turn), 0.15, std::sin(turn)};
            const glm::dvec3 direction = glm::normalize((i + 1 == count ? 1.4 : 0.5) * ahead + away);
            addLeaf(mesh, branch.at(t), direction, 0.13 + 0.06 * uniform(branch.number, i));
        }
    }
    return mesh;
}

Mesh meadow(double radius, int tufts) {
    Mesh mesh;
    for (int i = 0; i < tufts; ++i) {
        const double away = radius * std::sqrt((i + 0.5) / tufts), around = kGoldenAngle * i + uniform(i, 0);
        const glm::dvec3 foot{away * std::cos(around), -0.005, away * std::sin(around)};
        const double height = 0.09 + 0.10 * uniform(i, 1), turn = glm::pi<double>() * uniform(i, 2);
        for (const double angle : {turn, turn + glm::half_pi<double>()}) {
            const glm::dvec3 half = 0.10 * glm::dvec3{std::cos(angle), 0, std::sin(angle)};
            const glm::dvec3 lean = 0.05 * glm::dvec3{uniform(i, 3) - 0.5, 0, uniform(i, 4) - 0.5};
            addCard(mesh, {foot, foot + lean + glm::dvec3{0, height, 0}}, half);
        }
    }
    return mesh;
}

}  // namespace samples
