#include <doctest/doctest.h>

#include <cstdio>
#include <string>

#include "closed_mesh.hpp"
#include "exact.hpp"
#include "random.hpp"
#include "shader_source.hpp"

using f32::SurfacePoint;
using glm::dvec3;
using glm::vec3;
using test::Random;

namespace {

constexpr float kFar = 3.0e38f;
using Triangle = std::array<vec3, 3>;

f32::TriangleHit intersect(const vec3& origin, const vec3& direction, const Triangle& t, float tMax = kFar) {
    return f32::intersectTriangle(origin, f32::shearOf(direction), t[0], t[1], t[2], tMax);
}

SurfacePoint pointOn(const f32::TriangleHit& hit, const Triangle& t) {
    return f32::trianglePoint(hit, t[0], t[1], t[2]);
}

dvec3 randomPoint(const Triangle& t, Random& random) {
    double b[3];
    for (double& weight : b) weight = random.coin() ? random.uniform() : std::pow(10.0, random.uniform(-10, 0));
    return (b[0] * dvec3(t[0]) + b[1] * dvec3(t[1]) + b[2] * dvec3(t[2])) / (b[0] + b[1] + b[2]);
}

/// Any direction; a quarter of them all but in the plane of `ng`.
vec3 leaving(const vec3& ng, Random& random) {
    const dvec3 w = random.direction();
    if (random.uniform() > 0.25) return vec3(w);
    return vec3(glm::normalize(w - dvec3(ng) * glm::dot(w, dvec3(ng)) * (1 - std::pow(10.0, random.uniform(-8, 0)))));
}

struct Tally {
    int triangles = 0;
    int rays = 0;
    int selfHits = 0;
};

/// pbrt's Reintersect test: rays that leave a random point of a triangle, found by a ray from a random place.
template <typename MakeTriangle>
Tally reintersect(MakeTriangle makeTriangle, Random& random) {
    Tally tally;
    while (tally.triangles < 1000) {
        const Triangle t = makeTriangle();
        const dvec3 target = randomPoint(t, random);
        const vec3 origin(target + random.direction() * std::abs(random.spread(8)));
        const f32::TriangleHit hit = intersect(origin, vec3(glm::normalize(target - dvec3(origin))), t);
        if (!hit.hit) continue;
        ++tally.triangles;
        const SurfacePoint point = pointOn(hit, t);
        for (int i = 0; i < 2000; ++i) {
            const vec3 w = leaving(point.ng, random);
            ++tally.rays;
            tally.selfHits += intersect(f32::offsetRayOrigin(point.p, point.pError, point.ng, w), w, t).hit;
        }
    }
    return tally;
}

/// A ray that was followed to its hit.
struct Arrival {
    vec3 direction;
    float t;
    SurfacePoint point;
};

/// Places where a ray may start again, for the comparison.
using Offset = vec3 (*)(const vec3& rayOrigin, const Arrival& arrival, const vec3& w);

vec3 alongNormal(const vec3& rayOrigin, const Arrival& arrival, const vec3& w, float distance) {
    const vec3 p = rayOrigin + arrival.direction * arrival.t;
    return p + arrival.point.ng * (glm::dot(w, arrival.point.ng) < 0 ? -distance : distance);
}

/// Waechter and Binder, Ray Tracing Gems ch. 6.
vec3 integerSteps(const vec3& rayOrigin, const Arrival& arrival, const vec3& w) {
    const vec3 p = rayOrigin + arrival.direction * arrival.t;
    const vec3 n = glm::dot(w, arrival.point.ng) < 0 ? -arrival.point.ng : arrival.point.ng;
    vec3 result;
    for (int i = 0; i < 3; ++i) {
        const int steps = static_cast<int>(256.0f * n[i]);
        result[i] = std::abs(p[i]) < 1.0f / 32 ? p[i] + n[i] / 65536
                                               : glm::intBitsToFloat(glm::floatBitsToInt(p[i]) + (p[i] < 0 ? -steps : steps));
    }
    return result;
}

vec3 errorBounded(const vec3&, const Arrival& arrival, const vec3& w) {
    return f32::offsetRayOrigin(arrival.point.p, arrival.point.pError, arrival.point.ng, w);
}

const struct {
    const char* name;
    Offset offset;
} kMethods[] = {
    {"1e-3 along the normal", [](const vec3& o, const Arrival& a, const vec3& w) { return alongNormal(o, a, w, 1e-3f); }},
    {"1e-5 along the normal", [](const vec3& o, const Arrival& a, const vec3& w) { return alongNormal(o, a, w, 1e-5f); }},
    {"1e-5 + 1e-4 t", [](const vec3& o, const Arrival& a, const vec3& w) { return alongNormal(o, a, w, 1e-5f + 1e-4f * a.t); }},
    {"integer steps", integerSteps},
    {"error bounds, as here", errorBounded},
};

/// A test without any care for the origin: Moeller and Trumbore, t > 0.
bool meetsCarelessly(const vec3& origin, const vec3& d, const Triangle& t) {
    const vec3 e1 = t[1] - t[0];
    const vec3 e2 = t[2] - t[0];
    const vec3 p = glm::cross(d, e2);
    const float determinant = glm::dot(e1, p);
    const vec3 s = origin - t[0];
    const vec3 q = glm::cross(s, e1);
    const float u = glm::dot(s, p) / determinant;
    const float v = glm::dot(d, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / determinant > 0;
}

/// Percentages of rays that go wrong after a hit on a triangle of size 1, seen from 10 away, at `distance` from zero.
struct Failures {
    double selfHits;  // by the careless test
    double ownTest;   // by intersectTriangle
    double missed;    // a parallel sheet, `gap` in front of the triangle
};

Failures failuresOf(Offset offset, double distance, double gap) {
    Random random(11);
    int rays = 0;
    int careless = 0;
    int own = 0;
    int missed = 0;
    int towardsSheet = 0;
    for (int i = 0; i < 500; ++i) {
        const dvec3 center = random.direction() * distance;
        Triangle t;
        for (vec3& p : t) p = vec3(center + random.inCube(0.7));
        const dvec3 target = (dvec3(t[0]) + dvec3(t[1]) + dvec3(t[2])) / 3.0;
        const vec3 origin(target + random.direction() * 10.0);
        Arrival arrival;
        arrival.direction = vec3(glm::normalize(target - dvec3(origin)));
        const f32::TriangleHit hit = intersect(origin, arrival.direction, t);
        if (!hit.hit) continue;
        arrival.t = hit.t;
        arrival.point = pointOn(hit, t);
        const vec3 facing = glm::dot(arrival.direction, arrival.point.ng) < 0 ? arrival.point.ng : -arrival.point.ng;
        Triangle sheet = t;
        for (vec3& p : sheet) p = vec3(dvec3(p) + dvec3(facing) * gap);
        for (int k = 0; k < 200; ++k) {
            const vec3 w(random.direction());
            const vec3 start = offset(origin, arrival, w);
            ++rays;
            careless += meetsCarelessly(start, w, t);
            own += intersect(start, w, t).hit;
            if (glm::dot(w, facing) < 0.3f) continue;
            ++towardsSheet;
            missed += !intersect(start, w, sheet).hit;
        }
    }
    return {100.0 * careless / rays, 100.0 * own / rays, 100.0 * missed / towardsSheet};
}

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%6.1f", value);
    return text;
}

}  // namespace

TEST_CASE("rays never find the triangle that they leave") {
    Random random(1);
    const auto anyCoordinates = [&] {
        Triangle t;
        for (vec3& p : t) p = vec3(random.spread(8), random.spread(8), random.spread(8));
        return t;
    };
    const auto anySizeAndPlace = [&] {
        const double size = std::abs(random.spread(8));
        const dvec3 center = random.direction() * std::abs(random.spread(8));
        Triangle t;
        for (vec3& p : t) p = vec3(center + random.inCube(size));
        return t;
    };
    const Tally needles = reintersect(anyCoordinates, random);
    const Tally placed = reintersect(anySizeAndPlace, random);
    CHECK(needles.rays + placed.rays == 4000000);
    CHECK(needles.selfHits == 0);
    CHECK(placed.selfHits == 0);
}

TEST_CASE("rays never find the sphere that they leave outward and cross it once inward") {
    Random random(2);
    int spheres = 0;
    int found = 0;
    int shortChords = 0;
    while (spheres < 1000) {
        const vec3 center(random.direction() * std::abs(random.spread(4)));
        const float radius = static_cast<float>(std::abs(random.spread(4)));
        const dvec3 target = dvec3(center) + random.direction() * static_cast<double>(radius);
        const vec3 origin(target + random.direction() * std::abs(random.spread(4)));
        const vec3 direction(glm::normalize(target - dvec3(origin)));
        const f32::SphereHit hit = f32::intersectSphere(origin, direction, center, radius, kFar);
        if (!hit.hit || radius < 64 * 6e-8f * glm::length(center)) continue;  // a sphere of a few units in the last place
        ++spheres;
        const SurfacePoint point = f32::spherePoint(origin, direction, hit.t, center, radius);
        for (int i = 0; i < 2000; ++i) {
            const vec3 w = leaving(point.ng, random);
            const vec3 start = f32::offsetRayOrigin(point.p, point.pError, point.ng, w);
            const f32::SphereHit again = f32::intersectSphere(start, w, center, radius, kFar);
            const float cosine = glm::dot(w, point.ng);
            if (cosine >= 0) found += again.hit;
            const float chord = -2 * cosine * radius;
            if (chord > 0.01f * radius + 64 * glm::length(point.pError)) shortChords += !again.hit || again.t < 0.9f * chord;
        }
    }
    CHECK(found == 0);
    CHECK(shortChords == 0);
}

TEST_CASE("rays that leave a convex mesh outward find nothing behind them") {
    Random random(3);
    for (const double translation : {0.0, 1e1, 1e3}) {
        const std::vector<Triangle> triangles =
            test::placed(test::ball(1), dvec3(1), dvec3(translation, -translation, translation));
        int found = 0;
        for (int i = 0; i < 20000; ++i) {
            const Triangle& t = triangles[random.index(static_cast<uint32_t>(triangles.size()))];
            const dvec3 target = randomPoint(t, random);  // half of them within 1e-10 to 1 of an edge or vertex
            const vec3 origin(target + random.direction() * 3.0);
            const f32::TriangleHit hit = intersect(origin, vec3(glm::normalize(target - dvec3(origin))), t);
            if (!hit.hit) continue;
            const SurfacePoint point = pointOn(hit, t);
            for (int k = 0; k < 4; ++k) {
                vec3 w = leaving(point.ng, random);
                if (glm::dot(w, point.ng) < 0) w = -w;
                const vec3 start = f32::offsetRayOrigin(point.p, point.pError, point.ng, w);
                for (const Triangle& other : triangles) found += intersect(start, w, other).hit;
            }
        }
        CAPTURE(translation);
        CHECK(found == 0);
    }
}

TEST_CASE("rays that bounce about inside of closed meshes stay inside") {
    const dvec3 tilted = glm::normalize(dvec3(1, 0.3, 0.2));
    const dvec3 across = glm::normalize(glm::cross(tilted, dvec3(0.1, 0.4, 1)));
    const dvec3 third = glm::cross(tilted, across);
    test::ClosedMesh cube;
    for (int i = 0; i < 8; ++i) cube.positions.push_back(dvec3(i & 1, i >> 1 & 1, i >> 2) - 0.5);
    for (const auto& q :
         {std::array<uint32_t, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
        cube.faces.push_back({q[0], q[1], q[2]});
        cube.faces.push_back({q[0], q[2], q[3]});
    }
    test::ClosedMesh tiltedCube = cube;
    for (dvec3& p : tiltedCube.positions) p = p.x * tilted + p.y * across + p.z * third;
    const struct {
        std::string name;
        test::ClosedMesh mesh;
        int allowed;
    } cases[] = {{"cube", cube, 0}, {"tilted cube", tiltedCube, 4}, {"ball", test::ball(1), 0}};
    for (const auto& c : cases) {
        Random random(4);
        const std::vector<Triangle> triangles = test::placed(c.mesh, dvec3(1), dvec3(0));
        int escaped = 0;
        for (int path = 0; path < 2000; ++path) {
            vec3 origin(0);
            vec3 direction(random.direction());
            for (int bounce = 0; bounce < 200; ++bounce) {
                f32::TriangleHit best{false, kFar, 0, 0};
                const Triangle* found = nullptr;
                for (const Triangle& t : triangles) {
                    const f32::TriangleHit hit = intersect(origin, direction, t, best.t);
                    if (!hit.hit) continue;
                    best = hit;
                    found = &t;
                }
                escaped += !found;
                if (!found) break;
                const SurfacePoint point = pointOn(best, *found);
                const vec3 ng = glm::dot(direction, point.ng) < 0 ? point.ng : -point.ng;
                direction = vec3(random.direction());
                if (glm::dot(direction, ng) < 0) direction = -direction;
                origin = f32::offsetRayOrigin(point.p, point.pError, ng, direction);
            }
        }
        MESSAGE(c.name, ": ", escaped, " of 400000 bounces lead out");
        CHECK(escaped <= c.allowed);
    }
}

TEST_CASE("ray origins compared by method") {
    std::string table =
        "rays that find their own triangle, in %, by distance from zero (0, 1e2, 1e3, 1e4, 1e5, 1e6) and\n"
        "rays that miss a second sheet (gap 1e-4 at 10, gap 1e-3 at 1e3)\n";
    for (const auto& method : kMethods) {
        const bool isOurs = method.offset == errorBounded;
        for (const double distance : {0.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
            const Failures failures = failuresOf(method.offset, distance, 1);
            table += figure(failures.selfHits);
            if (isOurs) CHECK(failures.selfHits == 0);
            if (isOurs) CHECK(failures.ownTest == 0);
        }
        const double nearGap = failuresOf(method.offset, 10, 1e-4).missed;
        const double farGap = failuresOf(method.offset, 1e3, 1e-3).missed;
        table += "   |" + figure(nearGap) + figure(farGap) + "   " + method.name + "\n";
        if (isOurs) CHECK(nearGap == 0);
        if (isOurs) CHECK(farGap == 0);
    }
    MESSAGE(table);
}
