// Primitives with a hierarchy over them, to be asked what they enclose and what comes near them.
#pragma once
#include <functional>
#include <optional>

#include "box_pairs.hpp"
#include "triangle_pair.hpp"

namespace minirtc {

Triangle triangleOf(const Primitive& primitive);

class Surface {
public:
    /// On up to `threads` threads (0: all cores), as all below: no answer depends on it.
    Surface(std::vector<Primitive> primitives, unsigned threads);

    const Aabb& box() const { return root_.box; }
    /// In the order of the leaves: those of a leaf are [index, index + count).
    const std::vector<Primitive>& primitives() const { return shapes_.primitives; }
    const Bvh& bvh() const { return bvh_; }
    const BvhChild& root() const { return root_; }

    /// How many times the surface goes round a point, outward normals counting 1; nothing where the point lies on it as far as double
    /// can tell. By the crossings of a ray in a direction of no meaning; of another one where it comes too close to an edge.
    std::optional<int> windingAt(const glm::dvec3& point) const;
    /// The same right before the front of one of its own triangles.
    std::optional<int> windingBefore(const Triangle& own) const;
    /// False where no primitive touches the box.
    bool mayTouch(const Aabb& box) const;

private:
    Geometry shapes_;  // its primitives only
    Bvh bvh_;
    BvhChild root_;
};

/// Asked of pairs whose boxes are near each other; true ends the search.
using PairQuestion = std::function<bool(const Primitive& a, const Primitive& b)>;

/// True as soon as `question` is true of a primitive of `a` and one of `b` that are no more than `reach` apart.
bool anyPair(const Surface& a, const Surface& b, double reach, const PairQuestion& question);

/// The same of two primitives of one surface. `question` is asked on several threads.
bool anyPairWithin(const Surface& surface, const PairQuestion& question, unsigned threads);

}  // namespace minirtc
