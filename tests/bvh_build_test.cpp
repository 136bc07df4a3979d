#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "bvh.hpp"

using namespace minirtc;

namespace {

Primitive triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Primitive primitive;
    primitive.p = {a, b, c};
    return primitive;
}

Primitive sphere(const glm::vec3& center, float radius) {
    Primitive primitive;
    primitive.p = {center, glm::vec3(radius, 0, 0), glm::vec3(0)};
    primitive.isSphere = true;
    return primitive;
}

Geometry repeat(const Primitive& primitive, size_t count) {
    Geometry geometry;
    geometry.primitives.assign(count, primitive);
    return geometry;
}

/// Triangles and spheres of many sizes at random places.
Geometry soup(size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<float>(random()) * 0x1p-32f * 2 - 1; };
    const auto point = [&] {
        const float x = uniform(), y = uniform(), z = uniform();
        return glm::vec3(x, y, z);
    };
    Geometry geometry;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 p = point() * 100.0f;
        const float size = std::exp2(8 * uniform());
        if (i % 10 == 0)
            geometry.primitives.push_back(sphere(p, size));
        else
            geometry.primitives.push_back(triangle(p, p + size * point(), p + size * point()));
    }
    return geometry;
}

/// A square of 2 n^2 triangles with a bump.
Geometry hill(int n, float height) {
    const auto point = [&](int i, int j) {
        const float x = static_cast<float>(i) / static_cast<float>(n), y = static_cast<float>(j) / static_cast<float>(n);
        return glm::vec3(x, y, height * std::sin(3 * x) * std::cos(4 * y));
    };
    Geometry geometry;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            geometry.primitives.push_back(triangle(point(i, j), point(i + 1, j), point(i + 1, j + 1)));
            geometry.primitives.push_back(triangle(point(i, j), point(i + 1, j + 1), point(i, j + 1)));
        }
    return geometry;
}

/// Fine bumps that long triangles cross, as beams and wires cross a room.
Geometry wiredHill(float offset) {
    Geometry geometry = hill(60, 0.1f);
    std::mt19937 random(11);
    const auto uniform = [&] { return static_cast<float>(random()) * 0x1p-32f; };
    for (int i = 0; i < 400; ++i) {
        const float x = uniform(), y = uniform(), z = uniform() * 0.3f, dx = uniform(), dy = uniform();
        geometry.primitives.push_back(triangle({x, y, z}, {x + dx, y + dy, z + 0.2f}, {x + 0.002f, y, z + 0.003f}));
    }
    for (Primitive& primitive : geometry.primitives)
        for (glm::vec3& p : primitive.p) p += offset;
    return geometry;
}

bool equal(const Aabb& a, const Aabb& b) {
    return a.lo == b.lo && a.hi == b.hi;
}

bool contains(const Aabb& outer, const Aabb& inner) {
    return glm::all(glm::lessThanEqual(outer.lo, inner.lo)) && glm::all(glm::greaterThanEqual(outer.hi, inner.hi));
}

/// How many leaves hold each primitive.
std::vector<uint32_t> leavesOf(const Bvh& bvh, size_t primitives) {
    std::vector<uint32_t> leaves(primitives);
    for (const uint32_t primitive : bvh.order) ++leaves.at(primitive);
    return leaves;
}

/// What a walk over the whole tree finds; throws where the tree breaks a promise of bvh.hpp.
struct Walk {
    const Geometry& geometry;
    const Bvh& bvh;
    std::vector<uint32_t> leavesOfPrimitive = leavesOf(bvh, geometry.primitives.size());
    uint32_t nextNode = 0;
    uint32_t nextPrimitive = 0;
    uint32_t leaves = 0;
    uint32_t depth = 0;

    Aabb visit(const BvhChild& child, uint32_t level) {
        Aabb box;
        if (child.count > 0) {
            ++leaves;
            REQUIRE(child.count <= kMaxLeafSize);
            REQUIRE(child.index == nextPrimitive);
            nextPrimitive += child.count;
            box = visitLeaf(child);
        } else {
            REQUIRE(child.index == nextNode);
            box = visitNode(level);
        }
        REQUIRE(equal(box, child.box));
        return box;
    }

    /// The box that it must have: that around its primitives. Where one lies in further leaves it may be smaller, but not for the others.
    Aabb visitLeaf(const BvhChild& child) const {
        const auto first = bvh.order.begin() + child.index, end = first + child.count;
        Aabb all, whole;
        for (auto at = first; at != end; ++at) {
            REQUIRE(std::count(first, end, *at) == 1);
            all.grow(bounds(geometry.primitives[*at]));
            if (leavesOfPrimitive[*at] == 1) whole.grow(bounds(geometry.primitives[*at]));
        }
        if (std::all_of(first, end, [&](uint32_t p) { return leavesOfPrimitive[p] == 1; })) return all;
        REQUIRE(contains(all, child.box));
        REQUIRE((whole.lo.x > whole.hi.x || contains(child.box, whole)));
        return child.box;
    }

    Aabb visitNode(uint32_t level) {
        const BvhNode& node = bvh.nodes.at(nextNode++);
        depth = std::max(depth, level);
        Aabb box = visit(node.child[0], level + 1);
        box.grow(visit(node.child[1], level + 1));
        return box;
    }
};

/// Every primitive lies in a leaf, and in one only unless it may be split; splitting keeps within its bytes.
void checkOrder(const Bvh& bvh, size_t primitives, BvhQuality quality = BvhQuality::high) {
    const std::vector<uint32_t> leaves = leavesOf(bvh, primitives);
    REQUIRE(std::count(leaves.begin(), leaves.end(), 0u) == 0);
    if (bvh.order.size() == primitives) return;
    REQUIRE(quality == BvhQuality::high);
    REQUIRE(static_cast<double>(48 * bvh.order.size() + 32 * bvh.nodes.size()) <= kBytesEach * static_cast<double>(primitives));
}

Bvh buildChecked(const Geometry& geometry, BvhQuality quality) {
    const Bvh bvh = buildBvh(geometry, 2, quality);
    checkOrder(bvh, geometry.primitives.size(), quality);
    Walk walk{geometry, bvh};
    walk.visitNode(1);
    REQUIRE(walk.nextNode == bvh.nodes.size());
    REQUIRE(walk.nextPrimitive == bvh.order.size());
    REQUIRE(walk.leaves == bvh.leaves);
    REQUIRE(walk.depth == bvh.depth);
    REQUIRE(bvh.depth <= kMaxDepth);
    REQUIRE(std::isfinite(bvh.sahCost));
    REQUIRE(bvh.sahCost == sahCost(bvh));
    return bvh;
}

/// Of both qualities; returns the default one.
Bvh buildChecked(const Geometry& geometry) {
    const Bvh fast = buildChecked(geometry, BvhQuality::fast);
    Bvh high = buildChecked(geometry, BvhQuality::high);
    REQUIRE(high.sahCost <= fast.sahCost);
    return high;
}

template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

}  // namespace

TEST_CASE("bounds of a triangle are its exact extremes") {
    const Aabb box = bounds(triangle({1, 5, -3}, {2, -4, 0}, {0.1f, 0, 7}));
    CHECK(equal(box, {{0.1f, -4, -3}, {2, 5, 7}}));
}

TEST_CASE("bounds of a sphere contain it, and are exact where float can be") {
    CHECK(equal(bounds(sphere({1, -2, 0.5f}, 2)), {{-1, -4, -1.5f}, {3, 0, 2.5f}}));
    std::mt19937 random(1);
    for (int i = 0; i < 10000; ++i) {
        const float center = std::ldexp(static_cast<float>(random()) - 0x1p31f, static_cast<int>(random() % 40) - 50);
        const float radius = std::ldexp(static_cast<float>(random()), static_cast<int>(random() % 40) - 60);
        const Aabb box = bounds(sphere(glm::vec3(center), radius));
        const double lo = double(center) - radius, hi = double(center) + radius;  // exact: far fewer than 53 bits apart
        REQUIRE(box.lo.x <= lo);
        REQUIRE(std::nextafter(box.lo.x, INFINITY) > lo);
        REQUIRE(box.hi.x >= hi);
        REQUIRE(std::nextafter(box.hi.x, -INFINITY) < hi);
    }
}

TEST_CASE("a single primitive gives one node whose second child is empty") {
    const Geometry geometry = repeat(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 1);
    const Bvh bvh = buildBvh(geometry, 2);
    REQUIRE(bvh.nodes.size() == 1);
    const BvhNode& root = bvh.nodes[0];
    CHECK(equal(root.child[0].box, bounds(geometry.primitives[0])));
    CHECK(root.child[0].count == 1);
    CHECK(equal(root.child[1].box, Aabb()));
    CHECK(root.child[1].index == root.child[0].index);
    CHECK(root.child[1].count == root.child[0].count);
    CHECK(bvh.order == std::vector<uint32_t>{0});
    CHECK(bvh.depth == 1);
    CHECK(bvh.leaves == 1);
    CHECK(bvh.sahCost == 2);
}

TEST_CASE("a few primitives in one place share a leaf") {
    for (uint32_t count = 2; count <= kMaxLeafSize; ++count) {
        const Bvh bvh = buildBvh(repeat(sphere({0, 0, 0}, 1), count), 2);
        checkOrder(bvh, count);
        REQUIRE(bvh.nodes.size() == 1);
        CHECK(bvh.nodes[0].child[0].count == count);
        CHECK(bvh.nodes[0].child[1].count == count);
        CHECK(equal(bvh.nodes[0].child[1].box, Aabb()));
        CHECK(bvh.leaves == 1);
        CHECK(bvh.sahCost == 1 + count);
    }
}

TEST_CASE("two primitives far apart get a leaf each") {
    Geometry geometry = repeat(sphere({0, 0, 0}, 1), 2);
    geometry.primitives[1] = sphere({100, 0, 0}, 1);
    const Bvh bvh = buildChecked(geometry);
    CHECK(bvh.leaves == 2);
    CHECK(bvh.depth == 1);
}

TEST_CASE("trees of ordinary input keep every promise") {
    for (uint32_t size = 5; size < 200; size += 13) buildChecked(soup(size, size));
    for (const size_t size : {1000, 9000, 50000}) buildChecked(soup(size, 7));
    buildChecked(hill(100, 0.3f));
    buildChecked(hill(100, 0.0f));  // all in a plane
}

TEST_CASE("the tree does not depend on the number of threads") {
    for (const Geometry& geometry :
         {soup(60000, 3), hill(150, 0.2f), wiredHill(0), repeat(sphere({0, 0, 0}, 1), 20000), soup(5, 1)}) {
        for (const BvhQuality quality : {BvhQuality::fast, BvhQuality::high}) {
            const Bvh expected = buildBvh(geometry, 1, quality);
            for (const unsigned threads : {2u, 3u, 7u, 0u}) {
                const Bvh bvh = buildBvh(geometry, threads, quality);
                CHECK(sameBytes(bvh.nodes, expected.nodes));
                CHECK(sameBytes(bvh.order, expected.order));
                CHECK(bvh.sahCost == expected.sahCost);
            }
        }
    }
}

TEST_CASE("identical primitives are divided evenly") {
    const Bvh bvh = buildChecked(repeat(triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 100000));
    CHECK(bvh.depth <= 16);
}

TEST_CASE("concentric spheres keep every promise") {
    Geometry geometry;
    for (int i = 0; i < 5000; ++i) geometry.primitives.push_back(sphere({3, 1, 2}, static_cast<float>(i + 1)));
    buildChecked(geometry);
}

TEST_CASE("exponentially growing sizes stay within the depth bound") {
    for (const float growth : {1.02f, 1.1f, 1.5f, 2.0f}) {
        Geometry geometry;
        for (float x = 1e-15f; x < 1e15f; x *= growth)
            for (int copy = 0; copy < 20; ++copy)
                geometry.primitives.push_back(triangle({x, 0, 0}, {x * growth, 0, 0}, {x, x, x * static_cast<float>(copy)}));
        buildChecked(geometry);
    }
}

TEST_CASE("one huge primitive among tiny ones keeps every promise") {
    Geometry geometry = hill(60, 0.1f);
    geometry.primitives.insert(geometry.primitives.begin() + 1234,
                               triangle({-1e6f, -1e6f, 0}, {1e6f, -1e6f, 0}, {0, 1e6f, 1e6f}));
    buildChecked(geometry);
}

TEST_CASE("coordinates at the ends of the range of float keep every promise") {
    for (const float scale : {1e-44f, 1e-38f, 1e-20f, 1e18f, 9e35f}) {
        Geometry geometry = soup(20000, 5);
        for (Primitive& primitive : geometry.primitives)
            for (glm::vec3& p : primitive.p) p *= scale;
        const Bvh bvh = buildBvh(geometry, 2);
        checkOrder(bvh, geometry.primitives.size());
        Walk walk{geometry, bvh};
        walk.visitNode(1);
        CHECK(walk.depth <= kMaxDepth);
    }
}

TEST_CASE("points on a line, whose boxes have no area, keep every promise") {
    Geometry geometry;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 p(static_cast<float>(i * i % 3001), 0, 0);
        geometry.primitives.push_back(triangle(p, p, p));
    }
    const Bvh bvh = buildChecked(geometry);
    CHECK(bvh.sahCost == 0);
    CHECK(bvh.depth <= 13);
}

TEST_CASE("sahCost of a tree made by hand is the sum over its boxes") {
    // Half areas: root 1*1+1*4+4*1 = 9, the inner child 1+2+2 = 5, the leaves 3, 3 and 1*1+1*.5+.5*1 = 2.
    Bvh bvh;
    bvh.nodes.resize(2);
    bvh.nodes[0].child[0] = {{{0, 0, 0}, {2, 1, 1}}, 1, 0};
    bvh.nodes[0].child[1] = {{{3.5f, 0, 0}, {4, 1, 1}}, 3, 4};
    bvh.nodes[1].child[0] = {{{0, 0, 0}, {1, 1, 1}}, 0, 1};
    bvh.nodes[1].child[1] = {{{1, 0, 0}, {2, 1, 1}}, 1, 2};
    CHECK(sahCost(bvh) == doctest::Approx((9 + 5 + 3 * 1 + 3 * 2 + 2 * 4) / 9.0));
}

TEST_CASE("spheres far from one another get a leaf each") {
    Geometry geometry;
    for (int i = 0; i < 4096; ++i) geometry.primitives.push_back(sphere({i % 16 * 10, i / 16 % 16 * 10, i / 256 * 10}, 1));
    const Bvh bvh = buildChecked(geometry);
    CHECK(bvh.leaves == 4096);
}

namespace {

bool isInside(const Aabb& box, const glm::dvec3& p, double rounding) {
    return glm::all(glm::greaterThanEqual(p, glm::dvec3(box.lo) - rounding)) &&
           glm::all(glm::lessThanEqual(p, glm::dvec3(box.hi) + rounding));
}

/// Boxes of the leaves that hold each primitive.
std::vector<std::vector<Aabb>> leafBoxes(const Bvh& bvh, size_t primitives) {
    std::vector<std::vector<Aabb>> boxes(primitives);
    for (const BvhNode& node : bvh.nodes)
        for (const BvhChild& child : node.child)
            for (uint32_t i = 0; i < child.count; ++i) boxes[bvh.order[child.index + i]].push_back(child.box);
    return boxes;
}

}  // namespace

TEST_CASE("every point of a split triangle is in a leaf that holds it") {
    for (const float offset : {0.0f, 1000.0f}) {
        const Geometry geometry = wiredHill(offset);
        const Bvh bvh = buildChecked(geometry, BvhQuality::high);
        const std::vector<std::vector<Aabb>> boxes = leafBoxes(bvh, geometry.primitives.size());
        const double rounding = 1e-15 * (1 + static_cast<double>(offset));
        std::mt19937 random(3);
        size_t split = 0;
        for (size_t i = 0; i < boxes.size(); ++i) {
            split += boxes[i].size() > 1;
            for (int k = 0; k < (boxes[i].size() > 1 ? 1000 : 1); ++k) {
                double u = random() * 0x1p-32, v = k % 3 ? random() * 0x1p-32 : 0;  // a third of them on an edge
                if (u + v > 1) u = 1 - u, v = 1 - v;
                const std::array<glm::vec3, 3>& p = geometry.primitives[i].p;
                const glm::dvec3 point = (1 - u - v) * glm::dvec3(p[0]) + u * glm::dvec3(p[1]) + v * glm::dvec3(p[2]);
                REQUIRE(std::any_of(boxes[i].begin(), boxes[i].end(),
                                    [&](const Aabb& box) { return isInside(box, point, rounding); }));
            }
        }
        CHECK(split > 100);
        CHECK(bvh.order.size() > geometry.primitives.size() + 100);
    }
}

TEST_CASE("splitting lowers the cost where triangles fill little of their boxes, and can be forbidden") {
    const Geometry geometry = wiredHill(0);
    const Bvh split = buildChecked(geometry, BvhQuality::high);
    const Bvh whole = buildBvh(geometry, 2, BvhQuality::high, 0);
    MESSAGE("cost " << whole.sahCost << " -> " << split.sahCost);
    CHECK(split.sahCost < 0.95 * whole.sahCost);
    CHECK(leavesOf(whole, geometry.primitives.size()) == std::vector<uint32_t>(geometry.primitives.size(), 1));
}

TEST_CASE("splitting keeps within the bytes that it is given, and more of them lower the cost") {
    const Geometry geometry = wiredHill(0);
    const auto count = static_cast<double>(geometry.primitives.size());
    double before = buildBvh(geometry, 2, BvhQuality::high, 0).sahCost;
    for (const double bytesEach : {68.0, 72.0}) {
        CAPTURE(bytesEach);
        const Bvh bvh = buildBvh(geometry, 2, BvhQuality::high, bytesEach);
        const double bytes = bytesOf(bvh.order.size(), bvh.nodes.size());
        CHECK(bytes <= bytesEach * count);
        CHECK(bytes > (bytesEach - 1) * count);
        CHECK(bvh.sahCost < 0.98 * before);
        before = bvh.sahCost;
    }
}

TEST_CASE("spheres are left whole among triangles that are split") {
    Geometry geometry = wiredHill(0);
    for (int i = 0; i < 300; ++i) {
        const float x = static_cast<float>(i);
        geometry.primitives.push_back(sphere(0.5f + 0.5f * glm::vec3(std::sin(3 * x), std::sin(5 * x), std::sin(7 * x)), 0.1f));
    }
    const Bvh bvh = buildChecked(geometry);
    const std::vector<uint32_t> leaves = leavesOf(bvh, geometry.primitives.size());
    CHECK(bvh.order.size() > geometry.primitives.size() + 100);
    CHECK(std::all_of(leaves.end() - 300, leaves.end(), [](uint32_t n) { return n == 1; }));
}

TEST_CASE("a fine mesh is left whole") {
    const Geometry geometry = hill(100, 0.3f);
    CHECK(buildBvh(geometry, 2).order.size() == geometry.primitives.size());
}

TEST_CASE("moving subtrees makes up for bad splits") {
    // Long thin triangles in all directions, whose boxes overlap however they are divided.
    Geometry geometry = soup(5000, 9);
    for (Primitive& primitive : geometry.primitives)
        if (!primitive.isSphere) primitive.p[2] = primitive.p[0] + 40.0f * (primitive.p[1] - primitive.p[0]) + glm::vec3(1e-2f);
    const Bvh fast = buildChecked(geometry, BvhQuality::fast);
    const Bvh high = buildChecked(geometry, BvhQuality::high);
    MESSAGE("cost " << fast.sahCost << " -> " << high.sahCost);
    CHECK(high.sahCost < 0.97 * fast.sahCost);
}
