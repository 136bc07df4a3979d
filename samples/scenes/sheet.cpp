#include "sheet.hpp"

#include <algorithm>

namespace samples {
namespace {

/// Vertices of a grid of nu x nv quads, row by row.
class Grid {
public:
    Grid(int nu, int nv) : nu_(nu), nv_(nv), rows_(static_cast<size_t>(nv) + 1) {
        for (std::vector<uint32_t>& row : rows_) row.resize(static_cast<size_t>(nu) + 1);
    }
    uint32_t& at(int i, int j) { return rows_[static_cast<size_t>(j)][static_cast<size_t>(i)]; }
    /// Once around, the way the faces run.
    std::vector<uint32_t> rim() {
        std::vector<uint32_t> vertices;
        vertices.reserve(2 * (static_cast<size_t>(nu_) + static_cast<size_t>(nv_)));
        for (int i = 0; i < nu_; ++i) vertices.push_back(at(i, 0));
        for (int j = 0; j < nv_; ++j) vertices.push_back(at(nu_, j));
        for (int i = nu_; i > 0; --i) vertices.push_back(at(i, nv_));
        for (int j = nv_; j > 0; --j) vertices.push_back(at(0, j));
        return vertices;
    }
    void addFaces(Mesh& mesh, bool front) {
        for (int j = 0; j < nv_; ++j) {
            for (int i = 0; i < nu_; ++i) {
                std::vector<uint32_t> corners{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
                if (!front) std::reverse(corners.begin(), corners.end());
                mesh.faces.push_back(makeFace(corners));
            }
        }
    }

private:
    int nu_;
    int nv_;
    std::vector<std::vector<uint32_t>> rows_;
};

uint32_t addVertex(Mesh& mesh, const glm::dvec3& p) {
    mesh.positions.push_back(p);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

void faceOutward(Mesh& mesh) {
    if (signedVolume(mesh) > 0) return;
    for (Face& face : mesh.faces) std::reverse(face.begin(), face.end());
}

}  // namespace

Mesh leaf(int nu, int nv, const std::function<LeafPoint(double, double)>& at) {
    Mesh mesh;
    Grid front(nu, nv);
    Grid back(nu, nv);
    for (int j = 0; j <= nv; ++j) {
        for (int i = 0; i <= nu; ++i) {
            const LeafPoint point = at(static_cast<double>(i) / nu, static_cast<double>(j) / nv);
            const bool edge = i == 0 || j == 0 || i == nu || j == nv;
            front.at(i, j) = addVertex(mesh, edge ? point.middle : point.middle + point.half);
            back.at(i, j) = edge ? front.at(i, j) : addVertex(mesh, point.middle - point.half);
        }
    }
    front.addFaces(mesh, true);
    back.addFaces(mesh, false);
    faceOutward(mesh);
    return mesh;
}

Mesh relief(double halfWidth, double halfDepth, double bottom, int nx, int nz,
            const std::function<double(double, double)>& height) {
    Mesh mesh;
    Grid top(nx, nz);
    for (int j = 0; j <= nz; ++j) {
        for (int i = 0; i <= nx; ++i) {
            const double x = halfWidth * (2.0 * i / nx - 1);
            const double z = halfDepth * (1 - 2.0 * j / nz);
            top.at(i, j) = addVertex(mesh, {x, height(x, z), z});
        }
    }
    top.addFaces(mesh, true);
    const std::vector<uint32_t> rim = top.rim();
    std::vector<uint32_t> below;
    for (uint32_t vertex : rim) {
        const glm::dvec3 p = mesh.positions[vertex];
        below.push_back(addVertex(mesh, {p.x, bottom, p.z}));
    }
    const uint32_t middle = addVertex(mesh, {0, bottom, 0});
    for (size_t i = 0; i < rim.size(); ++i) {
        const size_t next = (i + 1) % rim.size();
        mesh.faces.push_back(makeFace({rim[i], below[i], below[next], rim[next]}));
        mesh.faces.push_back(makeFace({middle, below[next], below[i]}));
    }
    return mesh;
}

void append(Mesh& whole, const Mesh& part) {
    const uint32_t first = static_cast<uint32_t>(whole.positions.size());
    whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
    for (const Face& face : part.faces) {
        Face copy = face;
        for (Corner& corner : copy) corner = {corner.position + first, kNone, kNone};
        whole.faces.push_back(copy);
    }
}

}  // namespace samples
