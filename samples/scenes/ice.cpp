#include "ice.hpp"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>

namespace samples {
namespace {

/// Places along one axis of the unrounded cube [-1,1]: close together near the ends, where the arcs will be.
std::vector<double> gridLine(double flat, int steps) {
    std::vector<double> line;
    for (int i = 0; i <= steps; ++i)
        line.push_back(-flat - (1 - flat) * std::tan(glm::quarter_pi<double>() * (steps - i) / steps));
    constexpr int kFlatPieces = 6;
    for (int i = 1; i < kFlatPieces; ++i) line.push_back(flat * (2.0 * i / kFlatPieces - 1));
    for (int i = 0; i <= steps; ++i) line.push_back(flat + (1 - flat) * std::tan(glm::quarter_pi<double>() * i / steps));
    return line;
}

/// The surface of a cubic lattice of n points an axis; vertices of neighbouring faces are shared.
class LatticeSurface {
public:
    explicit LatticeSurface(int n) : n_(n) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int i = 0; i + 1 < n; ++i) {
                for (int j = 0; j + 1 < n; ++j) addCell(axis, i, j);
            }
        }
    }
    std::vector<glm::ivec3> points;
    std::vector<Face> faces;

private:
    uint32_t vertex(int axis, int end, int i, int j) {
        glm::ivec3 p;
        p[axis] = end;
        p[(axis + 1) % 3] = i;
        p[(axis + 2) % 3] = j;
        const auto [entry, isNew] = known_.insert({{p.x, p.y, p.z}, static_cast<uint32_t>(points.size())});
        if (isNew) points.push_back(p);
        return entry->second;
    }
    void addCell(int axis, int i, int j) {
        const int far = n_ - 1;
        faces.push_back(makeFace({vertex(axis, far, i, j), vertex(axis, far, i + 1, j), vertex(axis, far, i + 1, j + 1),
                                  vertex(axis, far, i, j + 1)}));
        faces.push_back(makeFace(
            {vertex(axis, 0, i, j), vertex(axis, 0, i, j + 1), vertex(axis, 0, i + 1, j + 1), vertex(axis, 0, i + 1, j)}));
    }
    int n_;
    std::map<std::array<int, 3>, uint32_t> known_;
};

}  // namespace

Mesh roundedBox(const glm::dvec3& size, double fillet, int steps) {
    std::array<std::vector<double>, 3> lines;
    for (int axis = 0; axis < 3; ++axis) lines[static_cast<size_t>(axis)] = gridLine(1 - 2 * fillet / size[axis], steps);
    const LatticeSurface surface(static_cast<int>(lines[0].size()));
    Mesh mesh;
    mesh.faces = surface.faces;
    for (const glm::ivec3& at : surface.points) {
        const glm::dvec3 onCube = 0.5 * size *
                                  glm::dvec3{lines[0][static_cast<size_t>(at.x)], lines[1][static_cast<size_t>(at.y)],
                                             lines[2][static_cast<size_t>(at.z)]};
        const glm::dvec3 core = glm::clamp(onCube, fillet - 0.5 * size, 0.5 * size - fillet);
        mesh.positions.push_back(core + fillet * glm::normalize(onCube - core));
    }
    addNormals(mesh, 180);
    return mesh;
}

Mesh iceCube(double edge) {
    Mesh mesh = roundedBox(glm::dvec3(edge), 0.17 * edge, 6);
    for (glm::dvec3& p : mesh.positions) {
        const glm::dvec3 q = p / edge;
        const double melt = std::sin(4.1 * q.x + 3.3 * q.y + 0.7) * std::sin(3.7 * q.z - 2.3 * q.y + 1.9) +
                            0.5 * std::sin(7.3 * q.y + 1.1) * std::sin(6.1 * q.x - 5.3 * q.z);
        p *= 1 + 0.035 * melt;
    }
    addNormals(mesh, 180);
    return mesh;
}

}  // namespace samples
