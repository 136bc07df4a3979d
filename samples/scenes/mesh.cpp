#include "mesh.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace samples {
namespace {

std::string edgeName(const std::pair<uint32_t, uint32_t>& edge) {
    return "edge " + std::to_string(edge.first) + " to " + std::to_string(edge.second);
}

double angleAt(const Mesh& mesh, const Face& face, size_t corner) {
    const glm::dvec3& p = mesh.positions[face[corner].position];
    const glm::dvec3& next = mesh.positions[face[(corner + 1) % face.size()].position];
    const glm::dvec3& previous = mesh.positions[face[(corner + face.size() - 1) % face.size()].position];
    const glm::dvec3 a = next - p;
    const glm::dvec3 b = previous - p;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// A face at a vertex, as seen by the vertex's normal.
struct Incidence {
    uint32_t face;
    uint32_t corner;
    glm::dvec3 normal;  // unit, of the face
    double angle;
};

std::vector<std::vector<Incidence>> incidences(const Mesh& mesh) {
    std::vector<std::vector<Incidence>> at(mesh.positions.size());
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Face& face = mesh.faces[f];
        const glm::dvec3 normal = glm::normalize(areaVector(mesh, face));
        for (uint32_t c = 0; c < face.size(); ++c) at[face[c].position].push_back({f, c, normal, angleAt(mesh, face, c)});
    }
    return at;
}

}  // namespace

Face makeFace(const std::vector<uint32_t>& positions) {
    Face face;
    for (uint32_t position : positions) face.push_back({position, kNone, kNone});
    return face;
}

glm::dvec3 areaVector(const Mesh& mesh, const Face& face) {
    const glm::dvec3& origin = mesh.positions[face[0].position];
    glm::dvec3 sum{0};
    for (size_t i = 1; i + 1 < face.size(); ++i) {
        sum += glm::cross(mesh.positions[face[i].position] - origin, mesh.positions[face[i + 1].position] - origin);
    }
    return sum;
}

double signedVolume(const Mesh& mesh) {
    double sixfold = 0;
    for (const Face& face : mesh.faces) {
        for (size_t i = 1; i + 1 < face.size(); ++i) {
            sixfold += glm::dot(mesh.positions[face[0].position],
                                glm::cross(mesh.positions[face[i].position], mesh.positions[face[i + 1].position]));
        }
    }
    return sixfold / 6;
}

std::string manifoldDefect(const Mesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        const Face& face = mesh.faces[f];
        if (face.size() < 3 || !(glm::length(areaVector(mesh, face)) > 0)) return "face " + std::to_string(f) + " is degenerate";
        for (size_t i = 0; i < face.size(); ++i) ++uses[{face[i].position, face[(i + 1) % face.size()].position}];
    }
    for (const auto& [edge, count] : uses) {
        if (count != 1) return edgeName(edge) + " occurs " + std::to_string(count) + " times";
        if (uses.count({edge.second, edge.first}) == 0) return edgeName(edge) + " has no opposite";
    }
    return "";
}

void addNormals(Mesh& mesh, double creaseDegrees) {
    const double cosCrease = std::cos(glm::radians(creaseDegrees));
    mesh.normals.clear();
    for (const std::vector<Incidence>& vertex : incidences(mesh)) {
        std::vector<std::pair<glm::dvec3, uint32_t>> known;  // corners that see the same faces share one normal
        for (const Incidence& own : vertex) {
            glm::dvec3 sum{0};
            for (const Incidence& other : vertex) {
                if (glm::dot(own.normal, other.normal) > cosCrease) sum += other.normal * other.angle;
            }
            uint32_t index = kNone;
            for (const auto& [value, at] : known) {
                if (value == sum) index = at;
            }
            if (index == kNone) {
                index = static_cast<uint32_t>(mesh.normals.size());
                known.push_back({sum, index});
                mesh.normals.push_back(glm::normalize(sum));
            }
            mesh.faces[own.face][own.corner].normal = index;
        }
    }
}

}  // namespace samples
