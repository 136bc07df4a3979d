#include <doctest/doctest.h>

#include <algorithm>
#include <initializer_list>

#include "exact.hpp"
#include "random.hpp"
#include "shader_source.hpp"

using glm::dvec3;
using glm::vec3;
using test::exact;
using test::exact3;
using test::Random;

namespace {

constexpr float kFar = 3.0e38f;

/// The planes that boxes are given on: position = origin + scale * number.
struct Grid {
    vec3 origin;
    vec3 scale;
    vec3 planes;
    bool isQuantised() const { return planes.x == 65535 && origin.x != 0; }
    exact3 position(const vec3& number) const { return exact3(origin) + exact3(scale) * exact3(number); }
};

struct Box {
    vec3 lo, hi;
};

/// 16-bit planes over [-extent,extent]^3, as quantised nodes use them.
Grid quantisedGrid(float extent) {
    return {vec3(-extent), vec3(2 * extent / 65535 * 1.000001f), vec3(65535)};
}

/// Planes are coordinates, as float nodes use them.
Grid floatGrid(float extent) {
    return {vec3(0), vec3(1), vec3(extent)};
}

/// A box of any size, flat in one axis now and then.
Box randomBox(const Grid& grid, Random& random) {
    const bool whole = grid.isQuantised();
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const double lowest = whole ? 0 : -grid.planes[axis];
        const double a = random.uniform(lowest, grid.planes[axis]);
        const double size = random.index(8) == 0 ? 0 : (grid.planes[axis] - lowest) * std::pow(10.0, random.uniform(-5, 0));
        const double b = std::min<double>(grid.planes[axis], a + size);
        box.lo[axis] = static_cast<float>(whole ? std::floor(a) : a);
        box.hi[axis] = std::max(box.lo[axis], static_cast<float>(whole ? std::ceil(b) : b));
    }
    return box;
}

struct Ray {
    vec3 origin;
    vec3 direction;
};

struct Interval {
    exact entry, exit;
    bool empty() const { return entry > exit; }
};

/// The part of the line within the box, limited to t >= 0.
Interval exactSlabs(const Ray& ray, const exact3& lo, const exact3& hi) {
    Interval inside{0, std::numeric_limits<exact>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const exact o = ray.origin[axis];
        const exact d = ray.direction[axis];
        if (d == 0) {
            if (o < lo[axis] || o > hi[axis]) return {1, 0};
            continue;
        }
        const exact t0 = (lo[axis] - o) / d;
        const exact t1 = (hi[axis] - o) / d;
        inside.entry = std::max(inside.entry, std::min(t0, t1));
        inside.exit = std::min(inside.exit, std::max(t0, t1));
    }
    return inside;
}

f32::BoxHit intersect(const Grid& grid, const Ray& ray, const Box& box, float tMax = kFar) {
    const f32::SlabRay slabs = f32::slabRay(ray.origin, ray.direction, grid.origin, grid.scale, grid.planes);
    if (!grid.isQuantised()) return f32::intersectBox(slabs, box.lo, box.hi, tMax);
    const glm::uvec3 planes = glm::uvec3(box.lo) | glm::uvec3(box.hi) << 16u;
    return f32::intersectGridBox(f32::gridRay(slabs), planes, tMax);
}

/// A point of the box; each coordinate is on a face half of the time.
dvec3 pointOf(const Grid& grid, const Box& box, Random& random) {
    const dvec3 lo(grid.position(box.lo));
    const dvec3 hi(grid.position(box.hi));
    dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const double choice = random.uniform();
        p[axis] = choice < 0.25 ? lo[axis] : choice < 0.5 ? hi[axis] : random.uniform(lo[axis], hi[axis]);
    }
    return p;
}

/// A ray towards the box from `distance` away; half of them along an axis, or in a plane across one, with zeros of both signs.
Ray rayTo(const dvec3& target, double distance, Random& random) {
    dvec3 d = random.direction();
    if (random.coin()) {
        const uint32_t zeros = 1 + random.index(6);  // which components
        for (int axis = 0; axis < 3; ++axis) {
            if (zeros >> axis & 1) d[axis] = 0;
        }
        d = glm::normalize(d);
    }
    Ray ray{vec3(target - d * distance), vec3(d)};
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) ray.direction[axis] = random.coin() ? 0.0f : -0.0f;
    }
    return ray;
}

struct Tally {
    int met = 0;     // boxes that the exact line meets
    int missed = 0;  // of those, by the float test
    int late = 0;    // of those, entered later than the exact entry
    int rejected = 0;
    int falselyMet = 0;
};

Tally compare(const Grid& grid, double distance, int count, Random& random) {
    Tally tally;
    for (int i = 0; i < count; ++i) {
        const Box box = randomBox(grid, random);
        const Ray ray = rayTo(pointOf(grid, box, random), distance, random);
        const Interval inside = exactSlabs(ray, grid.position(box.lo), grid.position(box.hi));
        const float tMax = random.coin() || inside.empty() ? kFar : std::nextafter(static_cast<float>(inside.entry), kFar);
        const f32::BoxHit hit = intersect(grid, ray, box, tMax);
        if (inside.empty()) {
            ++tally.rejected;
            tally.falselyMet += hit.hit;
        } else {
            ++tally.met;
            tally.missed += !hit.hit;
            tally.late += hit.tNear > inside.entry && hit.tNear > 0;
        }
    }
    return tally;
}

/// On both grids: of `count` boxes and rays from each distance, in extents, none that the exact line meets is missed or entered late.
void checkNoneMissed(std::initializer_list<float> extents, std::initializer_list<double> distances, int count, Random& random) {
    for (const float extent : extents) {
        for (const Grid& grid : {quantisedGrid(extent), floatGrid(extent)}) {
            for (const double distance : distances) {
                const Tally tally = compare(grid, distance * static_cast<double>(extent), count, random);
                CAPTURE(extent);
                CAPTURE(grid.planes.x);
                CAPTURE(distance);
                CHECK(tally.met > count / 10);
                CHECK(tally.missed == 0);
                CHECK(tally.late == 0);
            }
        }
    }
}

}  // namespace

TEST_CASE("no box is missed by rounding from any distance on either grid") {
    Random random(1);
    checkNoneMissed({1e-3f, 1, 1e5f}, {0, 1e-3, 1, 1e3, 1e6}, 100000, random);
}

TEST_CASE("no box is missed at the ends of the range of coordinates on either grid") {
    Random random(5);
    checkNoneMissed({1e-20f, 1e15f, 1e18f}, {0, 1e-3, 1, 10}, 20000, random);
}

TEST_CASE("a quantised plane is left no sooner than it lies, and by no more than two and a quarter planes later") {
    Random random(6);
    int early = 0;
    double latest = 0;
    for (int i = 0; i < 3000000; ++i) {
        const auto scale = static_cast<float>(random.uniform(1, 1.001));
        const auto middle = static_cast<float>(random.uniform(-70000, 70000));
        const f32::GridRay ray = f32::gridRay({vec3(scale), vec3(middle), vec3(middle)});  // slabs without slack
        const uint32_t plane = random.index(65536);
        const float exit = f32::exitPlane(plane << 16, ray.exit.x) * ray.scale.x + ray.far.x;
        const double late = static_cast<double>(exit) - (static_cast<double>(plane) * static_cast<double>(scale) + middle);
        early += late < 0;
        latest = std::max(latest, late);
    }
    CHECK(early == 0);
    CHECK(latest < 2.25);
    CHECK(latest > 1);
}

TEST_CASE("the empty box of a quantised node is missed") {
    Random random(7);
    const Grid grid = quantisedGrid(1);
    const Box empty{vec3(65535), vec3(0)};
    int met = 0;
    for (int i = 0; i < 100000; ++i) met += intersect(grid, rayTo(random.inCube(), random.uniform(0, 1e3), random), empty).hit;
    CHECK(met == 0);
}

TEST_CASE("axis-parallel rays in the planes of faces meet the box with zeros of either sign") {
    Random random(2);
    int missed = 0;
    int rays = 0;
    for (const float extent : {1.0f, 1e5f}) {
        for (int i = 0; i < 200000; ++i) {
            const Grid grid = floatGrid(extent);
            Box box = randomBox(grid, random);
            const int flat = static_cast<int>(random.index(3));
            if (i % 2 == 0) box.hi[flat] = box.lo[flat];
            const int along = static_cast<int>(random.index(3));
            Ray ray{box.lo, vec3(0)};
            for (int axis = 0; axis < 3; ++axis) {
                ray.origin[axis] = random.coin() ? box.lo[axis] : box.hi[axis];
                ray.direction[axis] = random.coin() ? 0.0f : -0.0f;
            }
            const bool forward = random.coin();
            ray.direction[along] = forward ? 1.0f : -1.0f;
            ray.origin[along] = forward ? box.lo[along] - extent * 3 : box.hi[along] + extent * 3;
            ++rays;
            missed += !intersect(grid, ray, box).hit;
        }
    }
    CHECK(rays == 400000);
    CHECK(missed == 0);
}

TEST_CASE("a box on a quantised plane that a ray lies in is met") {
    // A power of two, so that plane positions and the ray's coordinates are equal exactly.
    const Grid grid{vec3(-8), vec3(0x1p-12f), vec3(65535)};
    Random random(3);
    int missed = 0;
    for (int i = 0; i < 200000; ++i) {
        const Box box = randomBox(grid, random);
        const int along = static_cast<int>(random.index(3));
        Ray ray{vec3(random.coin() ? grid.position(box.lo) : grid.position(box.hi)), vec3(random.coin() ? 0.0f : -0.0f)};
        ray.direction[along] = random.coin() ? 1.0f : -1.0f;
        ray.origin[along] = -20 * ray.direction[along];
        missed += !intersect(grid, ray, box).hit;
    }
    CHECK(missed == 0);
}

TEST_CASE("boxes that the line passes by are rejected") {
    Random random(4);
    for (const Grid& grid : {quantisedGrid(1), floatGrid(1)}) {
        int passed = 0;
        int met = 0;
        for (int i = 0; i < 1000000; ++i) {
            const Box box = randomBox(grid, random);
            const vec3 origin(random.inCube(10));
            const Ray ray{origin, vec3(glm::normalize(random.inCube() - dvec3(origin)))};
            if (!exactSlabs(ray, grid.position(box.lo), grid.position(box.hi)).empty()) continue;
            ++passed;
            met += intersect(grid, ray, box).hit;
        }
        const double share = static_cast<double>(met) / passed;
        MESSAGE("boxes met in vain from up to 10 extents away: ", met, " of ", passed);
        CHECK(share < 1e-4);
    }
    // The slack is a few roundings: a box beside a ray by 4e-6 of the scene's extent is passed by.
    const Grid grid = floatGrid(1);
    const Box box{vec3(-0.5f), vec3(0.5f)};
    CHECK(intersect(grid, {vec3(0.5f, 0, -3), vec3(0, 0, 1)}, box).hit);
    CHECK_FALSE(intersect(grid, {vec3(0.500004f, 0, -3), vec3(0, 0, 1)}, box).hit);
    CHECK_FALSE(intersect(grid, {vec3(0, 0, 3), vec3(0, 0, 1)}, box).hit);
    CHECK_FALSE(intersect(grid, {vec3(0, 0, -3), vec3(0, 0, 1)}, box, 2).hit);
    CHECK(intersect(grid, {vec3(0, 0, 0), vec3(0, 0, 1)}, box).tNear == 0);
}
