#include "board.hpp"

#include "ice.hpp"

namespace samples {

Mesh board(const glm::dvec3& size, double fillet) {
    Mesh mesh = roundedBox(size, fillet, 3);
    for (const glm::dvec3& p : mesh.positions) mesh.uvs.push_back({p.x / size.x + 0.5, 0.5 - p.z / size.z});
    for (glm::dvec3& p : mesh.positions) p.y -= size.y / 2;
    for (Face& face : mesh.faces) {
        for (Corner& corner : face) corner.uv = corner.position;
    }
    return mesh;
}

}  // namespace samples
