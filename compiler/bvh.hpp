// Two-wide bounding volume hierarchy with both child boxes in the parent.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "geometry.hpp"

namespace minirtc {

struct Aabb {
    glm::vec3 lo{3.402823466e38f};
    glm::vec3 hi{-3.402823466e38f};
    void grow(const glm::vec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
    void grow(const Aabb& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
    /// Half of the surface area; 0 when empty.
    float halfArea() const {
        const glm::vec3 d = glm::max(hi - lo, glm::vec3(0));
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

/// A child of a node: an inner node (count 0, `index` its place in Bvh::nodes, always greater than the parent's)
/// or a leaf of `count` primitives from `index` on in Bvh::order.
struct BvhChild {
    Aabb box;
    uint32_t index = 0;
    uint32_t count = 0;
};

struct BvhNode {
    BvhChild child[2];
};

/// nodes[0] is the root; depth-first order, first child next to its parent. A tree over a single leaf has one node whose
/// second child is an empty box with a copy of the first child's leaf reference.
struct Bvh {
    std::vector<BvhNode> nodes;
    std::vector<uint32_t> order;  // leaf slot -> primitive; a primitive is in a leaf once, in several leaves where it was split
    uint32_t depth = 0;           // inner nodes on the longest path from the root: bounds the traversal stack
    uint32_t leaves = 0;
    double sahCost = 0;  // expected cost of a random ray: 1 a node, 1 a primitive, relative to the root's area
    double buildMs = 0;
};

constexpr uint32_t kMaxLeafSize = 4;
constexpr uint32_t kMaxDepth = 48;

/// The exact float bounds of a primitive.
Aabb bounds(const Primitive& primitive);

/// The expected cost of a random ray that meets the root's box: 1 a node visited, 1 a primitive tested. 0 where that box is flat
/// in two directions, as no random ray meets it.
double sahCost(const Bvh& bvh);

/// Fast: binned SAH. High: nodes whose halves would overlap are split at planes, with the triangles that cross them, then subtrees are moved to where
/// they cost less, which takes ten times as long or more.
enum class BvhQuality { fast, high };

/// Of what a leaf holds of a primitive (48 each) and of 16-bit nodes (32 each).
double bytesOf(size_t references, size_t nodes);

/// For each primitive, by bytesOf: triangles are split no more often than keeps them below.
constexpr double kBytesEach = 70;

/// On `threads` threads (0: all cores). The tree does not depend on the number of threads. A primitive that was split is found by every ray that meets
/// the box of one of its pieces. With 0 for `bytesEach`, and in the fast build, each primitive is in one leaf.
Bvh buildBvh(const Geometry& geometry, unsigned threads, BvhQuality quality = BvhQuality::high, double bytesEach = kBytesEach);

}  // namespace minirtc
