// The rays that minirt-bench traces: the same for everyone, on every machine.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace bench {

using Triangle = std::array<glm::vec3, 3>;
using Triangles = std::vector<Triangle>;

constexpr uint32_t kNoHit = 0xffffffffu;
constexpr float kRayEnd = 1e30f;

/// origin + t * direction with 0 < t < tMax, direction of unit length; the layout that the kernels read.
struct Ray {
    glm::vec3 origin;
    float unused;
    glm::vec3 direction;
    float tMax;
};

struct Hit {
    float t;
    uint32_t primitive;  // kNoHit: none, t is undefined; of any-hit rays any other number
};

/// A sphere around a mesh.
struct Surroundings {
    glm::vec3 center;
    float radius;
};
Surroundings surroundingsOf(const Triangles& mesh);

/// A camera's rays through the centres of width x height pixels, both multiples of 8: tiles of 8 x 8 pixels, row by row in a tile.
std::vector<Ray> primaryRays(const Surroundings& mesh, uint32_t width, uint32_t height);

/// `perHit` times all the hits in turn, from just off the surface on the side that the ray came from. Equal seeds give equal rays,
/// and what one ray gets does not depend on the others' hits.
struct SecondaryRays {
    std::vector<Ray> shadow;   // towards points of a cube that shines; they end there
    std::vector<Ray> diffuse;  // cosine-weighted
};
SecondaryRays secondaryRays(const Triangles& mesh, const std::vector<Ray>& rays, const std::vector<Hit>& hits, uint32_t perHit,
                            uint32_t seed);

/// Fisher and Yates.
std::vector<Ray> shuffled(std::vector<Ray> rays, uint32_t seed);

}  // namespace bench
