#include <doctest/doctest.h>

#include <algorithm>

#include "closed_mesh.hpp"
#include "exact.hpp"
#include "random.hpp"
#include "shader_source.hpp"

using glm::dvec3;
using glm::vec3;
using test::exact;
using test::Random;

namespace {

constexpr float kFar = 3.0e38f;
using Triangle = std::array<vec3, 3>;

f32::TriangleHit intersect(const vec3& origin, const vec3& direction, const Triangle& t, float tMax = kFar) {
    return f32::intersectTriangle(origin, f32::shearOf(direction), t[0], t[1], t[2], tMax);
}

f64::TriangleHit intersectInDouble(const vec3& origin, const vec3& direction, const Triangle& t) {
    return f64::intersectTriangle(origin, f64::shearOf(direction), t[0], t[1], t[2], kFar);
}

bool hitsAny(const vec3& origin, const vec3& direction, const std::vector<Triangle>& triangles) {
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const Triangle& t) { return intersect(origin, direction, t).hit; });
}

/// A point of the triangle; half of them close to an edge or a vertex.
dvec3 pointOf(const Triangle& t, Random& random) {
    double b[3];
    for (double& weight : b) weight = random.coin() ? random.uniform() : std::pow(10.0, random.uniform(-10, 0));
    return (b[0] * dvec3(t[0]) + b[1] * dvec3(t[1]) + b[2] * dvec3(t[2])) / (b[0] + b[1] + b[2]);
}

/// Rays from inside of a closed mesh that end on its vertices or edges, half of them along an axis so that they meet these
/// exactly.
int leaks(const test::ClosedMesh& mesh, const dvec3& inside, double translation, bool edges, Random& random) {
    const dvec3 offset = glm::normalize(dvec3(1, 0.9, 1.1)) * translation;
    const std::vector<Triangle> triangles = test::placed(mesh, dvec3(1), offset);
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
        const Triangle& t = triangles[random.index(static_cast<uint32_t>(triangles.size()))];
        const float along = edges ? static_cast<float>(random.uniform()) : 0.0f;
        const vec3 target = t[0] + along * (t[1] - t[0]);
        vec3 origin(inside + offset);
        vec3 direction = vec3(glm::normalize(dvec3(target) - dvec3(origin)));
        if (random.coin()) {
            const vec3 toTarget = glm::abs(direction);
            const int axis = toTarget.x > toTarget.y && toTarget.x > toTarget.z ? 0 : toTarget.y > toTarget.z ? 1 : 2;
            const float sign = direction[axis] < 0 ? -1.0f : 1.0f;
            const float start = origin[axis];
            const bool straight = toTarget[axis] > 0.9f && start != target[axis];
            if (straight) {
                origin = target;
                origin[axis] = start;
                direction = vec3(0);
                direction[axis] = sign;
            }
        }
        missed += !hitsAny(origin, direction, triangles);
    }
    return missed;
}

}  // namespace

TEST_CASE("rays at the shared vertices and edges of a closed mesh never leak") {
    Random random(1);
    for (const double translation : {0.0, 1e2, 1e4, 1e6}) {
        for (const bool edges : {false, true}) {
            CAPTURE(translation);
            CAPTURE(edges);
            CHECK(leaks(test::ball(2), dvec3(0.01, 0.02, -0.03), translation, edges, random) == 0);
            CHECK(leaks(test::torus(12, 8), dvec3(0.7, 0.01, 0.02), translation, edges, random) == 0);
        }
    }
}

TEST_CASE("closed meshes of needles and meshes far away do not leak") {
    Random random(2);
    const test::ClosedMesh mesh = test::ball(2);
    for (const double stretch : {1e3, 1e5}) {
        const std::vector<Triangle> needles = test::placed(mesh, dvec3(stretch, 1, 1 / stretch), dvec3(0));
        int missed = 0;
        for (int i = 0; i < 10000; ++i) missed += !hitsAny(vec3(0), vec3(random.direction()), needles);
        for (int i = 0; i < 10000; ++i) {
            const Triangle& t = needles[random.index(static_cast<uint32_t>(needles.size()))];
            missed += !hitsAny(vec3(0), vec3(glm::normalize(dvec3(t[0]))), needles);
        }
        CAPTURE(stretch);
        CHECK(missed == 0);
    }
    for (const double distance : {1e2, 1e4, 1e5}) {
        const std::vector<Triangle> triangles = test::placed(mesh, dvec3(1), dvec3(0));
        int missed = 0;
        for (int i = 0; i < 10000; ++i) {
            const vec3 origin(random.direction() * distance);
            const dvec3 target = random.inCube(0.4);
            missed += !hitsAny(origin, vec3(glm::normalize(target - dvec3(origin))), triangles);
        }
        CAPTURE(distance);
        CHECK(missed == 0);
    }
}

TEST_CASE("float finds what double finds away from the edges") {
    Random random(3);
    // Triangles of size about 1 seen from `distance`: rounding moves the ray by about 1e-7 * distance, edges come into play at
    // 1e6.
    for (const double distance : {1.0, 1e2, 1e4}) {
        int both = 0;
        int lost = 0;
        for (int i = 0; i < 100000; ++i) {
            Triangle t;
            for (vec3& p : t) p = vec3(random.inCube());
            const vec3 origin(random.direction() * distance);
            const dvec3 center = (dvec3(t[0]) + dvec3(t[1]) + dvec3(t[2])) / 3.0;
            const vec3 direction(glm::normalize(center - dvec3(origin)));
            const f64::TriangleHit expected = intersectInDouble(origin, direction, t);
            const double margin = 2e-6 * distance;
            if (!expected.hit || expected.b1 < margin || expected.b2 < margin || expected.b1 + expected.b2 > 1 - margin) continue;
            const dvec3 n = glm::cross(dvec3(t[1] - t[0]), dvec3(t[2] - t[0]));
            if (std::abs(glm::dot(n, dvec3(direction))) < 20 * margin) continue;  // thin or edge-on: within rounding of its edges
            ++both;
            lost += !intersect(origin, direction, t).hit;
        }
        CAPTURE(distance);
        CHECK(both > 10000);
        CHECK(lost == 0);
    }
}

TEST_CASE("no accepted hit lies behind the origin") {
    Random random(4);
    int hits = 0;
    int behind = 0;
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
        const double size = std::abs(random.spread(4));
        Triangle t;
        for (vec3& p : t) p = vec3(random.inCube(size));
        const dvec3 ng = glm::normalize(glm::cross(dvec3(t[1] - t[0]), dvec3(t[2] - t[0])));
        dvec3 towards = random.direction();
        if (i % 2 == 1)
            towards = glm::normalize(towards - ng * glm::dot(towards, ng) * (1 - std::pow(10.0, random.uniform(-7, 0))));
        // Before the plane, on it or behind it, from far away to within rounding.
        const double distance = i % 3 == 0 ? 0 : size * random.spread(8);
        const vec3 origin(pointOf(t, random) - towards * distance);
        const vec3 direction(towards);
        const f32::TriangleHit hit = intersect(origin, direction, t);
        if (!hit.hit) continue;
        const f32::PlaneHit plane = f32::intersectPlane(direction, t[0] - origin, t[1] - t[0], t[2] - t[0]);
        if (!plane.steep) continue;  // edge-on: the plane is at every depth of the triangle
        ++hits;
        const exact expected = test::planeDistance(origin, direction, {t[0], t[1], t[2]});
        behind += expected <= 0;
        if (i % 2 == 0 && std::abs(glm::dot(ng, towards)) > 0.1) {
            worst =
                std::max(worst, static_cast<double>(std::abs(expected - hit.t) / std::max(expected, static_cast<exact>(size))));
        }
    }
    MESSAGE(hits, " hits; steep ones: largest |t - exact| over the distance or the triangle's size: ", worst);
    CHECK(hits > 150000);
    CHECK(behind == 0);
    CHECK(worst <= 1e-5);
}

TEST_CASE("hits are kept down to 1e-5 of the size of the triangle") {
    Random random(8);
    int candidates = 0;
    double farthestLost = 0;
    double farthestLostAligned = 0;
    for (int i = 0; i < 500000; ++i) {
        Triangle t;
        const bool aligned = i % 2 == 0;
        for (vec3& p : t) p = vec3(random.inCube());
        if (aligned) t[0].y = t[1].y = t[2].y = static_cast<float>(random.uniform(-1, 1));
        const dvec3 n = glm::cross(dvec3(t[1] - t[0]), dvec3(t[2] - t[0]));
        const vec3 direction(random.direction());
        if (std::abs(glm::dot(n, dvec3(direction))) < 0.3) continue;
        const dvec3 center = (dvec3(t[0]) + dvec3(t[1]) + dvec3(t[2])) / 3.0;
        const vec3 origin(center - dvec3(direction) * std::pow(10.0, random.uniform(-8, -3)));
        const exact expected = test::planeDistance(origin, direction, {t[0], t[1], t[2]});
        if (expected <= 0) continue;
        ++candidates;
        double& lost = aligned ? farthestLostAligned : farthestLost;
        if (!intersect(origin, direction, t).hit) lost = std::max(lost, static_cast<double>(expected));
    }
    MESSAGE("largest t of a lost hit on triangles of size 1: ", farthestLost,
            ", in planes across an axis: ", farthestLostAligned);
    CHECK(candidates > 100000);
    CHECK(farthestLost <= 2e-5);
    CHECK(farthestLostAligned == 0);
}

TEST_CASE("float agrees with double in t and barycentrics") {
    Random random(5);
    double worstT = 0;
    double worstB = 0;
    for (int i = 0; i < 200000; ++i) {
        Triangle t;
        for (vec3& p : t) p = vec3(random.inCube());
        const dvec3 n = glm::cross(dvec3(t[1] - t[0]), dvec3(t[2] - t[0]));
        const vec3 direction(random.direction());
        const vec3 origin = vec3(pointOf(t, random)) - direction * 10.0f;
        const double facing = std::abs(glm::dot(n, dvec3(direction)));
        const f32::TriangleHit hit = intersect(origin, direction, t);
        const f64::TriangleHit expected = intersectInDouble(origin, direction, t);
        if (facing < 0.1 || !hit.hit || !expected.hit) continue;
        worstT = std::max(worstT, std::abs(hit.t - expected.t) / expected.t);
        worstB = std::max({worstB, std::abs(hit.b1 - expected.b1), std::abs(hit.b2 - expected.b2)});
    }
    MESSAGE("well-shaped triangles from 10 away: relative error of t ", worstT, ", error of barycentrics ", worstB);
    CHECK(worstT <= 2e-6);
    CHECK(worstB <= 2e-5);
}

TEST_CASE("a ray in the plane misses and its neighbours still hit") {
    const Triangle floor = {vec3(-1, 0, -1), vec3(1, 0, -1), vec3(0, 0, 1)};
    const Triangle wall = {vec3(-1, -1, 1), vec3(1, -1, 1), vec3(0, 1, 1)};
    const f32::TriangleHit inPlane = intersect({0, 0, -3}, {0, 0, 1}, floor);
    CHECK_FALSE(inPlane.hit);
    CHECK(intersect({0, 0, -3}, {0, 0, 1}, wall).hit);
    // Any plane, where rounding keeps the determinant from 0: whatever is reported lies within the triangle's depths.
    Random random(6);
    int outside = 0;
    for (int i = 0; i < 100000; ++i) {
        Triangle t;
        for (vec3& p : t) p = vec3(random.inCube());
        const dvec3 a = pointOf(t, random);
        const vec3 direction(glm::normalize(dvec3(t[0]) - a));
        const f32::TriangleHit hit = intersect(vec3(a) - 5.0f * direction, direction, t);
        outside += hit.hit && !(hit.t > 1 && hit.t < 9);
    }
    CHECK(outside == 0);
}

TEST_CASE("degenerate triangles miss") {
    Random random(7);
    int hits = 0;
    for (int i = 0; i < 100000; ++i) {
        const vec3 a(random.inCube());
        const vec3 b(random.inCube());
        const vec3 direction(random.direction());
        const vec3 target = random.coin() ? a : vec3(glm::mix(dvec3(a), dvec3(b), random.uniform()));
        const vec3 origin = target - direction * 3.0f;
        hits += intersect(origin, direction, {a, a, a}).hit;
        hits += intersect(origin, direction, {a, a, b}).hit;
        hits += intersect(origin, direction, {a, b, a}).hit;
        hits += intersect(origin, direction, {a, b, b}).hit;
    }
    CHECK(hits == 0);
    // Three different points of a line.
    CHECK_FALSE(intersect({0, 0, -1}, {0, 0, 1}, {vec3(-1, 0, 0), vec3(0, 0, 0), vec3(1, 0, 0)}).hit);
}

TEST_CASE("hits lie strictly between 0 and tMax") {
    const Triangle t = {vec3(-1, -1, 0), vec3(1, -1, 0), vec3(0, 1, 0)};
    CHECK(intersect({0, 0, -2}, {0, 0, 1}, t).hit);
    CHECK(intersect({0, 0, -2}, {0, 0, 1}, t).t == 2);
    CHECK_FALSE(intersect({0, 0, -2}, {0, 0, 1}, t, 2).hit);
    CHECK_FALSE(intersect({0, 0, -2}, {0, 0, -1}, t).hit);
    CHECK_FALSE(intersect({0, 0, 0}, {0, 0, 1}, t).hit);
    CHECK(intersect({0, 0, -1e-6f}, {0, 0, 1}, t).hit);
}

TEST_CASE("front and back are hit alike and barycentrics belong to the second and third vertex") {
    const Triangle t = {vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)};
    for (const float side : {-1.0f, 1.0f}) {
        const f32::TriangleHit hit = intersect({0.25f, 0.5f, side}, {0, 0, -side}, t);
        REQUIRE(hit.hit);
        CHECK(hit.b1 == 0.25f);
        CHECK(hit.b2 == 0.5f);
        const f32::SurfacePoint point = f32::trianglePoint(hit, t[0], t[1], t[2]);
        CHECK(point.p == vec3(0.25f, 0.5f, 0));
        CHECK(point.ng == vec3(0, 0, 1));
    }
}
