#include "oracle.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "support.hpp"

using namespace oracle;

namespace {

const Triangle kUnitTriangle = {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};

Ray down(float x, float y, float tMin = 0, float tMax = kInfinity) {
    return {{x, y, 2}, tMin, {0, 0, -1}, tMax};
}

Mesh soup(size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<float>(random()) * 0x1p-31f - 1; };
    Mesh mesh(count);
    for (Triangle& triangle : mesh) {
        const glm::vec3 p(uniform(), uniform(), uniform());
        for (glm::vec3& corner : triangle) corner = p + 0.2f * glm::vec3(uniform(), uniform(), uniform());
    }
    return mesh;
}

struct RayKind {
    const char* name;
    std::vector<Ray> (*make)(const Mesh&, size_t, uint32_t);
};
const RayKind kRayKinds[] = {
    {"random", randomRays}, {"axis-parallel", axisParallelRays}, {"edge", edgeRays}, {"vertex", vertexRays}};

bool equal(const JudgedHit& a, const JudgedHit& b) {
    return a.t == b.t && a.primitive == b.primitive && a.clearance == b.clearance && a.cosTheta == b.cosTheta;
}

/// The height of the triangle's plane above `center`.
double planeDistance(const Triangle& triangle, const glm::vec3& center) {
    const glm::dvec3 a(triangle[0]), b(triangle[1]), c(triangle[2]);
    return std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), a - glm::dvec3(center)));
}

/// Where a ray enters a sphere, or infinity.
double enterSphere(const Ray& ray, const glm::vec3& center, double radius) {
    const glm::dvec3 d(ray.direction), o = glm::dvec3(ray.origin) - glm::dvec3(center);
    const double a = glm::dot(d, d), b = glm::dot(o, d), discriminant = b * b - a * (glm::dot(o, o) - radius * radius);
    return discriminant < 0 ? INFINITY : (-b - std::sqrt(discriminant)) / a;
}

}  // namespace

TEST_CASE("a single triangle is hit inside, on its edges and at its corners, from both sides") {
    const DoubleScene scene({kUnitTriangle});
    for (const Ray& ray :
         {down(0.25f, 0.25f), down(0.5f, 0), down(0, 0.5f), down(0.5f, 0.5f), down(0, 0), down(1, 0), down(0, 1)}) {
        const JudgedHit hit = scene.closestHit(ray);
        CHECK(hit.primitive == 0);
        CHECK(hit.t == 2);
        CHECK(hit.cosTheta == 1);
    }
    CHECK(scene.closestHit({{0.25f, 0.25f, -3}, 0, {0, 0, 2}, kInfinity}).t == 1.5);
    for (const Ray& ray : {down(-1e-6f, 0.5f), down(0.5f, -1e-6f), down(0.5f, 0.500001f), down(3, 3)})
        CHECK(scene.closestHit(ray).primitive == kNone);
}

TEST_CASE("the interval of a ray includes its ends") {
    const DoubleScene scene({kUnitTriangle});
    CHECK(scene.closestHit(down(0.25f, 0.25f, 2, 2)).primitive == 0);
    CHECK(scene.closestHit(down(0.25f, 0.25f, 2.0001f)).primitive == kNone);
    CHECK(scene.closestHit(down(0.25f, 0.25f, 0, 1.9999f)).primitive == kNone);
}

TEST_CASE("a ray in the plane of a triangle misses it") {
    const DoubleScene scene({kUnitTriangle});
    CHECK(scene.closestHit({{-1, 0.25f, 0}, 0, {1, 0, 0}, kInfinity}).primitive == kNone);
}

TEST_CASE("clearance is the distance to the nearest edge up to the hit") {
    const DoubleScene scene({kUnitTriangle});
    CHECK(scene.maxClearance() == doctest::Approx(1e-4 * std::sqrt(2.0)));
    CHECK(scene.closestHit(down(0.25f, 0x1p-15f)).clearance == 0x1p-15);
    CHECK(scene.closestHit(down(-0x1p-15f, 0.25f)).clearance == 0x1p-15);
    CHECK(scene.closestHit(down(-3 * 0x1p-17f, -4 * 0x1p-17f)).clearance == 5 * 0x1p-17);
    CHECK(scene.closestHit(down(0.25f, 0)).clearance == 0);
    CHECK(scene.closestHit(down(0.25f, 0.25f)).clearance == scene.maxClearance());
    CHECK(scene.closestHit(down(5, 5)).clearance == scene.maxClearance());
    const Ray slanting = {{0.25f, 1, 1}, 0, {0, -1, -1}, 0x1p10f};  // ends on the edge
    CHECK(scene.closestHit(slanting).clearance == 0);
    CHECK(scene.closestHit({slanting.origin, 0, slanting.direction, 0.5f}).clearance == scene.maxClearance());
}

TEST_CASE("of triangles in one place the first is hit") {
    const DoubleScene scene(Mesh(50, kUnitTriangle));
    CHECK(scene.closestHit(down(0.25f, 0.25f)).primitive == 0);
}

TEST_CASE("the tree and the linear search agree in all bits") {
    for (const Mesh& mesh : {soup(2000, 1), icosphere({1, 2, 3}, 0.5f, 3), icosphere({1e4f, 0, 0}, 1, 3), soup(3, 2)})
        for (const RayKind& kind : kRayKinds) {
            INFO(kind.name);
            const DoubleScene scene(mesh);
            for (const Ray& ray : kind.make(mesh, 500, 11)) REQUIRE(equal(scene.closestHit(ray), scene.closestHitLinear(ray)));
        }
}

TEST_CASE("rays on an icosphere keep between its inscribed and its circumscribed sphere") {
    const glm::vec3 center(3, -1, 2);
    const Mesh mesh = icosphere(center, 2, 6);
    REQUIRE(mesh.size() == 81920);
    double inner = 2;
    for (const Triangle& triangle : mesh) inner = std::min(inner, planeDistance(triangle, center));
    CHECK(inner > 1.998);
    const DoubleScene scene(mesh);
    int hits = 0;
    for (const Ray& ray : randomRays(mesh, 20000, 5)) {
        const JudgedHit hit = scene.closestHit(ray);
        const double first = enterSphere(ray, center, 2 + 1e-6), last = enterSphere(ray, center, inner);
        REQUIRE(hit.t >= first);
        REQUIRE(hit.t <= last);
        hits += hit.primitive != kNone;
    }
    CHECK(hits > 10000);
}

TEST_CASE("the double oracle lets no ray at an edge or a vertex of a closed mesh through") {
    for (const glm::vec3& center : {glm::vec3(0), glm::vec3(1000, -300, 20)}) {
        const Mesh mesh = icosphere(center, 1, 5);
        const DoubleScene scene(mesh);
        for (const auto make : {edgeRays, vertexRays, axisParallelRays})
            for (const Ray& ray : make(mesh, 5000, 3)) {
                const double entry = enterSphere(ray, center, 0.997);  // at the silhouette a ray may pass
                REQUIRE((std::isinf(entry) || scene.closestHit(ray).t <= entry));
            }
    }
}

TEST_CASE("edge and vertex rays meet what they are aimed at") {
    const Mesh mesh = icosphere({0, 0, 0}, 1, 4);
    const DoubleScene scene(mesh);
    for (const auto make : {edgeRays, vertexRays})
        for (const Ray& ray : make(mesh, 5000, 3)) {
            const JudgedHit hit = scene.closestHit({ray.origin, 0.999f, ray.direction, 1.001f});  // the target may be hidden
            const double grazing = 0.05;  // such a ray may end at a face before its edge
            if (hit.cosTheta > grazing || hit.primitive == kNone) REQUIRE(hit.clearance < 1e-5);
        }
}

TEST_CASE("rays aimed at edges need edges that two triangles share") {
    CHECK(edgeRays({kUnitTriangle}, 10, 1).empty());
    CHECK(vertexRays({kUnitTriangle}, 10, 1).empty());
    const Triangle neighbour = {glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)};
    CHECK(edgeRays({kUnitTriangle, neighbour}, 10, 1).size() == 10);
    CHECK(vertexRays({kUnitTriangle, neighbour}, 10, 1).empty());
}

TEST_CASE("axis-parallel rays have two zeros and run through vertex coordinates") {
    const Mesh mesh = icosphere({0, 0, 0}, 1, 1);
    for (const Ray& ray : axisParallelRays(mesh, 1000, 9)) {
        REQUIRE((ray.direction.x == 0) + (ray.direction.y == 0) + (ray.direction.z == 0) == 2);
        for (int axis = 0; axis < 3; ++axis) {
            bool found = ray.direction[axis] != 0;
            for (const Triangle& triangle : mesh)
                for (const glm::vec3& p : triangle) found |= p[axis] == ray.origin[axis];
            REQUIRE(found);
        }
    }
}

TEST_CASE("equal seeds give equal rays, other seeds others") {
    const Mesh mesh = icosphere({0, 0, 0}, 1, 2);
    const auto bytes = [](const std::vector<Ray>& rays) {
        return std::string(reinterpret_cast<const char*>(rays.data()), rays.size() * sizeof(Ray));
    };
    for (const RayKind& kind : kRayKinds) {
        INFO(kind.name);
        REQUIRE(kind.make(mesh, 100, 1).size() == 100);
        CHECK(bytes(kind.make(mesh, 100, 1)) == bytes(kind.make(mesh, 100, 1)));
        CHECK(bytes(kind.make(mesh, 100, 1)) != bytes(kind.make(mesh, 100, 2)));
    }
}

TEST_CASE("Embree and the double oracle agree wherever the answer is clear") {
    if (!EmbreeScene::available()) return test::skip("needs Embree 3");
    const Mesh sphere = icosphere({3, -1, 2}, 2, 6);
    for (const Mesh& mesh : {sphere, soup(20000, 4)}) {
        const DoubleScene reference(mesh);
        const EmbreeScene embree(mesh, EmbreeScene::Mode::robust);
        for (const RayKind& kind : kRayKinds) {
            INFO(kind.name);
            for (const Ray& ray : kind.make(mesh, 10000, 21)) {
                const JudgedHit expected = reference.closestHit(ray);
                if (expected.clearance < 1e-4) continue;
                const Hit hit = closestHit(embree, ray);
                REQUIRE((hit.primitive == kNone) == (expected.primitive == kNone));
                if (hit.primitive == kNone) continue;
                const bool sameTime = std::abs(hit.t - expected.t) <= 1e-6 * expected.t / expected.cosTheta;
                REQUIRE(sameTime);
                if (mesh.size() == sphere.size()) REQUIRE(hit.primitive == expected.primitive);  // others cross one another
            }
        }
    }
}
