#include "surface.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "parallel.hpp"

namespace minirtc {
namespace {

unsigned worthThreads(size_t primitives, unsigned threads) {
    constexpr size_t kMany = 8192;
    return primitives < kMany ? 1 : threads;
}

/// No component is 0 and no two are alike, so that a ray is parallel to nothing that people build.
constexpr std::array<std::array<double, 3>, 8> kDirections = {{{0.5345, 0.2673, 0.8018},
                                                               {-0.3192, 0.8511, 0.4167},
                                                               {0.7713, -0.6171, 0.1547},
                                                               {-0.6831, -0.2139, -0.6983},
                                                               {0.1373, 0.5719, -0.8087},
                                                               {0.9137, 0.3571, -0.1931},
                                                               {-0.4271, 0.1733, 0.8874},
                                                               {0.2917, -0.8663, -0.4049}}};

struct Line {
    glm::dvec3 origin, direction;
};

bool meets(const Line& ray, const Aabb& box) {
    if (!(box.lo.x <= box.hi.x)) return false;
    const glm::dvec3 a = (glm::dvec3(box.lo) - ray.origin) / ray.direction, b = (glm::dvec3(box.hi) - ray.origin) / ray.direction;
    const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
    const double first = std::max({enter.x, enter.y, enter.z, 0.0}), last = std::min({leave.x, leave.y, leave.z});
    constexpr double kRounding = 1e-12;
    return first - last <= kRounding * (first + std::fabs(last));
}

/// dot(cross(a, b), d): its sign, 0 where rounding cannot tell.
int signOfProduct(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& d) {
    const glm::dvec3 x(a.y * b.z, a.z * b.x, a.x * b.y), y(a.z * b.y, a.x * b.z, a.y * b.x);
    constexpr double kRounding = 2e-15;
    const double product = glm::dot(x - y, d), error = kRounding * glm::dot(glm::abs(x) + glm::abs(y), glm::abs(d));
    return product > error ? 1 : product < -error ? -1 : 0;
}

/// 1 where the ray leaves through the triangle, -1 where it enters, 0 where it misses; nothing where rounding cannot tell.
std::optional<int> crossing(const Line& ray, const Triangle& t) {
    const glm::dvec3 a = t[0] - ray.origin, b = t[1] - ray.origin, c = t[2] - ray.origin;
    const std::array<int, 3> sides = {signOfProduct(a, b, ray.direction), signOfProduct(b, c, ray.direction),
                                      signOfProduct(c, a, ray.direction)};
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    if (*least < 0 && *most > 0) return 0;
    const int ahead =
        signOfProduct(t[1] - t[0], t[2] - t[0], a);  // its sign is that of the normal along the ray, if the plane is ahead
    if (*least == *most && *least != 0 && ahead != 0) return ahead == *least ? *least : 0;
    return std::nullopt;
}

std::optional<int> crossing(const Line& ray, const Primitive& primitive) {
    if (!primitive.isSphere) return crossing(ray, triangleOf(primitive));
    const double distance = glm::length(ray.origin - glm::dvec3(primitive.p[0])), radius = primitive.p[1].x;
    constexpr double kRounding = 1e-14;
    if (std::fabs(distance - radius) <= kRounding * radius) return std::nullopt;
    return distance < radius ? 1 : 0;
}

/// The sum of all crossings ahead, but those of the triangle `ignored`.
std::optional<int> windingAlong(const Surface& surface, const Line& ray, const Triangle* ignored) {
    int winding = 0;
    std::vector<BvhChild> open = {surface.root()};
    while (!open.empty()) {
        const BvhChild child = open.back();
        open.pop_back();
        if (!meets(ray, child.box)) continue;
        if (child.count == 0) {
            const BvhNode& node = surface.bvh().nodes[child.index];
            open.insert(open.end(), {node.child[0], node.child[1]});
            continue;
        }
        for (uint32_t i = child.index; i < child.index + child.count; ++i) {
            const Primitive& primitive = surface.primitives()[i];
            if (ignored && triangleOf(primitive) == *ignored) continue;
            const std::optional<int> crossed = crossing(ray, primitive);
            if (!crossed) return std::nullopt;
            winding += *crossed;
        }
    }
    return winding;
}

struct ChildPair {
    BvhChild a, b;
    bool isOne = false;  // a and b are the same child: its pairs with itself
};

/// Puts in `open` what is below a pair of which not both are leaves.
void descend(const ChildPair& pair, const Bvh& bvhA, const Bvh& bvhB, std::vector<ChildPair>& open) {
    if (pair.isOne) {
        const BvhChild(&child)[2] = bvhA.nodes[pair.a.index].child;
        open.insert(open.end(), {{child[0], child[1]}, {child[1], child[1], true}, {child[0], child[0], true}});
        return;
    }
    const bool splitA = pair.b.count > 0 || (pair.a.count == 0 && pair.a.box.halfArea() > pair.b.box.halfArea());
    for (int i = 1; i >= 0; --i) {
        if (splitA) open.push_back({bvhA.nodes[pair.a.index].child[i], pair.b});
        if (!splitA) open.push_back({pair.a, bvhB.nodes[pair.b.index].child[i]});
    }
}

bool isLeafPair(const ChildPair& pair) {
    return pair.a.count > 0 && pair.b.count > 0;
}

bool anyOfLeaves(const ChildPair& pair, const Surface& a, const Surface& b, double reach, const PairQuestion& question) {
    for (uint32_t i = 0; i < pair.a.count; ++i) {
        const Primitive& first = a.primitives()[pair.a.index + i];
        const Aabb box = bounds(first);
        for (uint32_t k = pair.isOne ? i + 1 : 0; k < pair.b.count; ++k) {
            const Primitive& second = b.primitives()[pair.b.index + k];
            if (areNear(box, bounds(second), reach) && question(first, second)) return true;
        }
    }
    return false;
}

bool anyBelow(const ChildPair& top, const Surface& a, const Surface& b, double reach, const PairQuestion& question,
              const std::atomic<bool>& stop) {
    std::vector<ChildPair> open = {top};
    while (!open.empty() && !stop) {
        const ChildPair pair = open.back();
        open.pop_back();
        if (!areNear(pair.a.box, pair.b.box, reach)) continue;
        if (!isLeafPair(pair)) {
            descend(pair, a.bvh(), b.bvh(), open);
        } else if (anyOfLeaves(pair, a, b, reach, question)) {
            return true;
        }
    }
    return false;
}

/// The pairs below the root that make work for many threads.
std::vector<ChildPair> tasksOf(const Surface& surface) {
    constexpr size_t kTasks = 512;
    std::vector<ChildPair> tasks = {{surface.root(), surface.root(), true}}, leaves, next;
    while (!tasks.empty() && tasks.size() < kTasks) {
        next.clear();
        for (const ChildPair& pair : tasks) {
            if (!areNear(pair.a.box, pair.b.box, 0)) continue;
            if (isLeafPair(pair))
                leaves.push_back(pair);
            else
                descend(pair, surface.bvh(), surface.bvh(), next);
        }
        tasks.swap(next);
    }
    tasks.insert(tasks.end(), leaves.begin(), leaves.end());
    return tasks;
}

}  // namespace

Triangle triangleOf(const Primitive& primitive) {
    return {glm::dvec3(primitive.p[0]), glm::dvec3(primitive.p[1]), glm::dvec3(primitive.p[2])};
}

Surface::Surface(std::vector<Primitive> primitives, unsigned threads) {
    shapes_.primitives = std::move(primitives);
    bvh_ = buildBvh(shapes_, worthThreads(shapes_.primitives.size(), threads), BvhQuality::high, 0);  // counts crossings
    std::vector<Primitive> ordered;
    ordered.reserve(bvh_.order.size());
    for (const uint32_t i : bvh_.order) ordered.push_back(shapes_.primitives[i]);
    shapes_.primitives = std::move(ordered);
    if (bvh_.nodes.empty()) return;
    for (const BvhChild& child : bvh_.nodes[0].child) root_.box.grow(child.box);
}

std::optional<int> Surface::windingAt(const glm::dvec3& point) const {
    for (const auto& [x, y, z] : kDirections) {
        const std::optional<int> winding = windingAlong(*this, {point, {x, y, z}}, nullptr);
        if (winding) return winding;
    }
    return std::nullopt;
}

std::optional<int> Surface::windingBefore(const Triangle& own) const {
    const glm::dvec3 centroid = (own[0] + own[1] + own[2]) / 3.0;
    for (const auto& [x, y, z] : kDirections) {
        glm::dvec3 direction(x, y, z);
        if (glm::dot(direction, areaVector(own)) < 0) direction = -direction;
        const std::optional<int> winding = windingAlong(*this, {centroid, direction}, &own);
        if (winding) return winding;
    }
    return std::nullopt;
}

bool Surface::mayTouch(const Aabb& box) const {
    std::vector<BvhChild> open = {root_};
    while (!open.empty()) {
        const BvhChild child = open.back();
        open.pop_back();
        if (!areNear(child.box, box, 0)) continue;
        if (child.count == 0) {
            const BvhNode& node = bvh_.nodes[child.index];
            open.insert(open.end(), {node.child[1], node.child[0]});
            continue;
        }
        for (uint32_t i = child.index; i < child.index + child.count; ++i)
            if (areNear(bounds(primitives()[i]), box, 0)) return true;
    }
    return false;
}

bool anyPair(const Surface& a, const Surface& b, double reach, const PairQuestion& question) {
    const std::atomic<bool> stop{false};
    return anyBelow({a.root(), b.root()}, a, b, reach, question, stop);
}

bool anyPairWithin(const Surface& surface, const PairQuestion& question, unsigned threads) {
    std::atomic<bool> found{false};
    const std::vector<ChildPair> tasks = tasksOf(surface);
    ThreadPool pool(worthThreads(surface.primitives().size(), threads));
    pool.parallelFor(tasks.size(), [&](size_t i) {
        if (!found && anyBelow(tasks[i], surface, surface, 0, question, found)) found = true;
    });
    return found;
}

}  // namespace minirtc
