// Polygon meshes: what every sample shape is, how it is checked, smoothed and written.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace samples {

constexpr uint32_t kNone = 0xffffffffu;

/// Indices into a Mesh's arrays; kNone where the corner has no normal or texture coordinate.
struct Corner {
    uint32_t position = 0;
    uint32_t normal = kNone;
    uint32_t uv = kNone;
};

/// Counterclockwise seen from outside, convex.
using Face = std::vector<Corner>;

struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec2> uvs;  // v up
    std::vector<Face> faces;
};

/// A face over the given positions, without normals or texture coordinates.
Face makeFace(const std::vector<uint32_t>& positions);

/// Not normalised; its length is twice the area of the face.
glm::dvec3 areaVector(const Mesh& mesh, const Face& face);

/// Positive for a closed mesh whose faces look outward.
double signedVolume(const Mesh& mesh);

/// What keeps the mesh from being a closed, consistently oriented 2-manifold; "" if it is one: every directed edge occurs
/// once, its opposite occurs once, and no face is degenerate.
std::string manifoldDefect(const Mesh& mesh);

/// Gives every corner the mean normal of the faces at its vertex that turn by less than `creaseDegrees` from its own face,
/// weighted by the angle at the vertex (Thuermer & Wuethrich 1998).
void addNormals(Mesh& mesh, double creaseDegrees);

/// Throws std::runtime_error when the file cannot be written. With `material`, the file uses that material of `material`.mtl.
void writeObj(const Mesh& mesh, const std::filesystem::path& path, const std::string& material = "");

}  // namespace samples
