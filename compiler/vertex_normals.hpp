// Smooth vertex normals for meshes that bring none.
#pragma once
#include "scene.hpp"

namespace minirtc {

/// A unit normal for each position of a mesh; zero where no face with an area meets or all cancel.
class VertexNormals {
public:
    VertexNormals() = default;
    VertexNormals(std::vector<uint32_t> vertexOfPosition, std::vector<glm::dvec3> normals)
        : vertexOfPosition_(std::move(vertexOfPosition)), normals_(std::move(normals)) {}
    const glm::dvec3& at(uint32_t position) const { return normals_[vertexOfPosition_[position]]; }

private:
    std::vector<uint32_t> vertexOfPosition_;
    std::vector<glm::dvec3> normals_;
};

/// The faces' normals averaged over each vertex by the angle they fill there (Thuermer & Wuethrich, Computing vertex normals
/// from polygonal facets, 1998): independent of how a flat face is cut. `points` are the positions; positions with the same
/// `rounded` value are one vertex.
VertexNormals averageNormals(const Mesh& mesh, const std::vector<glm::dvec3>& points, const std::vector<glm::vec3>& rounded);

}  // namespace minirtc
