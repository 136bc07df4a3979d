// Independent judges of ray tracing code: closest hits in double by a plain algorithm, the same by Embree, and rays that hurt.
// Nothing here shares code, data structures or numerics with what it judges.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "../samples/common/embree_scene.hpp"

namespace oracle {

constexpr uint32_t kNone = 0xffffffffu;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Triangle = std::array<glm::vec3, 3>;
using Mesh = std::vector<Triangle>;  // the position of a triangle is its primitive number

/// origin + t * direction with tMin <= t <= tMax. The direction may have any length but 0; t counts in its lengths.
struct Ray {
    glm::vec3 origin;
    float tMin;
    glm::vec3 direction;
    float tMax;
};

struct Hit {
    double t = std::numeric_limits<double>::infinity();
    uint32_t primitive = kNone;  // kNone: a miss
};

// --- Closest hits in double

/// A hit and how safe it is to demand the same one of another algorithm.
struct JudgedHit : Hit {
    /// The least distance, in the mesh's units, between the ray up to its hit and an edge of any triangle; at most maxClearance()
    /// of the scene. Where it is no more than the rounding errors of another algorithm, that one may rightly hit the
    /// neighbour, or see past a silhouette. It does not tell of triangles that cross or lie on one another: there compare `t`.
    double clearance = 0;
    /// |cosine| of the angle between the ray and the normal of the triangle; 0 for a miss. Where it is small, small errors are
    /// large along the ray.
    double cosTheta = 0;
};

/// Two-sided hits in double, signs in more where it matters, without any epsilon. A triangle is hit where the signed volumes of
/// the ray with its three edges do not differ in sign; an edge has the same volume in each of its triangles but for the sign, so
/// that none of the rays between two triangles is lost. Edges belong to their triangles; a ray in the plane misses. Of equal
/// distances the lowest primitive wins.
class DoubleScene {
public:
    explicit DoubleScene(Mesh mesh);
    /// By a bounding volume hierarchy of median splits. Equal in all bits to the linear search.
    JudgedHit closestHit(const Ray& ray) const;
    /// By a loop over all triangles.
    JudgedHit closestHitLinear(const Ray& ray) const;
    /// A ten-thousandth of the diagonal of the mesh's bounds.
    double maxClearance() const { return maxClearance_; }

private:
    struct Box {
        glm::dvec3 lo, hi;
    };
    struct Node {  // its children, at 2 * own + 1 and + 2, are halves of [begin, end); a leaf where the run is short
        Box box;
        uint32_t begin, end;
    };
    Box paddedBounds(const Triangle& triangle) const;
    static bool meets(const Box& box, const Ray& ray, double tMax);
    void build(size_t node, uint32_t begin, uint32_t end);
    template <typename Visit>
    void visitNear(size_t node, const Ray& ray, const double& end, const Visit& visit) const;

    Mesh mesh_;
    double maxClearance_ = 0;
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

// --- Closest hits by Embree

/// One ray at a time, in float. Only where EmbreeScene::available(): else a test that needs it skips. No judge of watertightness: of rays aimed at
/// vertices of a closed mesh Embree, robust or not, lets about one in a hundred through.
Hit closestHit(const EmbreeScene& scene, const Ray& ray);

// --- Rays. All start outside of the mesh's bounds, unless said, with tMin 0 and tMax infinite; equal seeds give equal rays.

/// From a sphere around the bounds towards random points inside them. Such rays prove little about edges.
std::vector<Ray> randomRays(const Mesh& mesh, size_t count, uint32_t seed);

/// Exactly along an axis, either way: two components of the direction are 0 of either sign. The other two coordinates of the
/// origin are coordinates of vertices (of one vertex in half of the rays), so that rays run in the planes of box faces.
std::vector<Ray> axisParallelRays(const Mesh& mesh, size_t count, uint32_t seed);

/// Towards float points on edges that two triangles share; the target is at t = 1 up to rounding. Empty without such edges.
std::vector<Ray> edgeRays(const Mesh& mesh, size_t count, uint32_t seed);

/// Towards vertices all of whose edges are shared by two triangles, likewise.
std::vector<Ray> vertexRays(const Mesh& mesh, size_t count, uint32_t seed);

// --- Meshes

/// A closed mesh of 20 * 4^level triangles with its vertices on the sphere (up to rounding), facing outwards. Triangles that
/// share a vertex agree in its bits.
Mesh icosphere(const glm::vec3& center, float radius, int level);

}  // namespace oracle
