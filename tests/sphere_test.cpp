#include <doctest/doctest.h>

#include <algorithm>

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

/// How far the point at distance t on the ray is from the sphere's surface.
exact distanceFromSurface(const vec3& origin, const vec3& direction, float t, const vec3& center, float radius) {
    const exact3 p = exact3(origin) + exact3(direction) * exact(t) - exact3(center);
    return std::abs(glm::length(p) - exact(radius));
}

/// Least distance of the ray's line from the centre, and the place where that is.
struct Approach {
    exact distance;
    exact t;
};

Approach approach(const vec3& origin, const vec3& direction, const vec3& center) {
    const exact3 f = exact3(origin) - exact3(center);
    const exact3 d(direction);
    const exact t = -glm::dot(f, d) / glm::dot(d, d);
    return {glm::length(f + d * t), t};
}

}  // namespace

TEST_CASE("hits lie on tiny and huge and distant spheres within roundings of the distance to the centre") {
    Random random(1);
    double worst = 0;
    double worstDecision = 0;
    int hits = 0;
    for (int i = 0; i < 1000000; ++i) {
        const vec3 center(random.direction() * std::abs(random.spread(4)));
        const auto radius = static_cast<float>(std::abs(random.spread(6)));
        // Aimed at the centre, at the limb, past it, or from within.
        const vec3 origin(dvec3(center) + random.direction() * (radius * std::abs(random.spread(4))));
        const dvec3 toCenter = dvec3(center) - dvec3(origin);
        const dvec3 beside = glm::normalize(glm::cross(toCenter, random.direction()));
        const double reach = radius * (random.coin() ? random.uniform(0, 1.2) : 1 + random.uniform(-1e-6, 1e-6));
        const vec3 direction(glm::normalize(toCenter + beside * reach));
        const f32::SphereHit hit = f32::intersectSphere(origin, direction, center, radius, kFar);
        const exact unit = 6e-8L * (glm::length(exact3(origin) - exact3(center)) + exact(radius));
        const Approach nearest = approach(origin, direction, center);
        if (hit.hit) {
            ++hits;
            worst = std::max(worst, static_cast<double>(distanceFromSurface(origin, direction, hit.t, center, radius) / unit));
            worstDecision = std::max(worstDecision, static_cast<double>((nearest.distance - exact(radius)) / unit));
        } else if (nearest.t > 0 || glm::length(exact3(origin) - exact3(center)) < exact(radius)) {
            worstDecision = std::max(worstDecision, static_cast<double>((exact(radius) - nearest.distance) / unit));
        }
    }
    MESSAGE(hits, " hits; in units of 6e-8 of (distance to the centre + radius): off the surface by ", worst,
            ", wrong hit or miss by ", worstDecision);
    CHECK(hits > 300000);
    CHECK(worst <= 10);
    CHECK(worstDecision <= 10);
}

TEST_CASE("a sphere of radius 1e6 under the feet is as flat as the ground") {
    const vec3 center(0, -1e6f, 0);
    for (const float height : {0.5f, 2.0f, 100.0f}) {
        const f32::SphereHit down = f32::intersectSphere(vec3(0, height, 0), vec3(0, -1, 0), center, 1e6f, kFar);
        REQUIRE(down.hit);
        CHECK(std::abs(down.t - height) <= 0.2f);  // positions near 1e6 have a spacing of 0.06
        CHECK_FALSE(f32::intersectSphere(vec3(0, height, 0), vec3(0, 1, 0), center, 1e6f, kFar).hit);
    }
}

TEST_CASE("the far side is hit from inside and the near one from outside") {
    const vec3 center(1, 2, 3);
    const vec3 x(1, 0, 0);
    CHECK(f32::intersectSphere(center, x, center, 2, kFar).t == 2);
    CHECK(f32::intersectSphere(center - 5.0f * x, x, center, 2, kFar).t == 3);
    CHECK_FALSE(f32::intersectSphere(center + 5.0f * x, x, center, 2, kFar).hit);
    CHECK_FALSE(f32::intersectSphere(center - 5.0f * x, x, center, 2, 3).hit);
    CHECK_FALSE(f32::intersectSphere(center, x, center, 2, 2).hit);
}

TEST_CASE("tangents touch once and stay finite") {
    const vec3 d(0, 0, 1);
    const f32::SphereHit touch = f32::intersectSphere(vec3(1, 0, -4), d, vec3(0), 1, kFar);
    REQUIRE(touch.hit);
    CHECK(touch.t == 4);
    CHECK_FALSE(f32::intersectSphere(vec3(std::nextafter(1.0f, 2.0f), 0, -4), d, vec3(0), 1, kFar).hit);
    CHECK_FALSE(f32::intersectSphere(vec3(1, 0, 0), d, vec3(0), 1, kFar).hit);  // starts at the point of contact
}

TEST_CASE("the refined point is on the sphere within its bound with a unit normal") {
    Random random(2);
    double worst = 0;
    double worstNormal = 0;
    for (int i = 0; i < 200000; ++i) {
        const vec3 center(random.direction() * std::abs(random.spread(3)));
        const auto radius = static_cast<float>(std::abs(random.spread(3)));
        const vec3 origin(dvec3(center) + random.direction() * (radius * std::abs(random.spread(3))));
        const vec3 direction(glm::normalize(dvec3(center) + random.direction() * (0.9 * radius) - dvec3(origin)));
        const f32::SphereHit hit = f32::intersectSphere(origin, direction, center, radius, kFar);
        if (!hit.hit) continue;
        const f32::SurfacePoint point = f32::spherePoint(origin, direction, hit.t, center, radius);
        const exact3 fromCenter = exact3(point.p) - exact3(center);
        const exact3 n = glm::normalize(fromCenter);
        const exact bound = glm::dot(glm::abs(n), exact3(point.pError));
        worst = std::max(worst, static_cast<double>(std::abs(glm::length(fromCenter) - exact(radius)) / bound));
        worstNormal = std::max(worstNormal, static_cast<double>(std::abs(glm::length(exact3(point.ng)) - 1)));
    }
    MESSAGE("off the sphere by ", worst, " of the bound; normals are of unit length to ", worstNormal);
    CHECK(worst <= 1);
    CHECK(worstNormal <= 4e-7);
}

TEST_CASE("float agrees with double") {
    Random random(3);
    double worst = 0;
    int disagreements = 0;
    for (int i = 0; i < 200000; ++i) {
        const vec3 origin(random.direction() * 10.0);
        const vec3 target(random.inCube(0.5));
        const vec3 direction(glm::normalize(dvec3(target) - dvec3(origin)));
        const f32::SphereHit hit = f32::intersectSphere(origin, direction, vec3(0), 1, kFar);
        const f64::SphereHit expected = f64::intersectSphere(dvec3(origin), dvec3(direction), dvec3(0), 1, 3e38);
        disagreements += hit.hit != expected.hit;
        worst = std::max(worst, std::abs(hit.t - expected.t) / expected.t);
    }
    MESSAGE("relative error of t from 10 radii away: ", worst);
    CHECK(worst <= 2e-6);
    CHECK(disagreements == 0);
}
