// The renderer's traversal on the device against independent oracles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu_context.hpp"
#include "ray_query.hpp"
#include "runtime_hooks.hpp"
#include "support.hpp"

using minirtc::LayoutChoice;
using oracle::Ray;
using test::GpuContext;
using test::QueryHit;
using test::QueryMode;
using test::RayQuery;

namespace {

constexpr double kEpsilon = 0x1p-24;

/// What the device gets and the same triangles for the oracles, in the same order and bits.
struct Model {
    minirtc::Scene scene;
    minirtc::Geometry geometry;
    oracle::Mesh mesh;
};

Model modelOf(minirtc::Scene scene, minirtc::Geometry geometry) {
    Model model{std::move(scene), std::move(geometry), {}};
    for (const minirtc::Primitive& primitive : model.geometry.primitives) model.mesh.push_back(primitive.p);
    return model;
}

/// By the compiler's own reader; `transforms` as in a scene file.
Model load(const std::string& name, const std::vector<minirtc::Transform>& transforms = {{}}) {
    minirtc::Diagnostics diagnostics;
    minirtc::Scene scene;
    scene.meshes.push_back(minirtc::loadObj(test::sharedDir() / "scenes/real/meshes" / name, false, scene, diagnostics));
    minirtc::Object object;
    object.name = name;
    object.mesh = 0;
    object.material = 0;
    object.instances = transforms;
    scene.objects.push_back(object);
    scene.materials.resize(1);
    minirtc::Geometry geometry = minirtc::flatten(scene, diagnostics);
    return modelOf(std::move(scene), std::move(geometry));
}

/// Triangles exactly as given, not recentred.
Model modelOf(const oracle::Mesh& mesh) {
    minirtc::Scene scene;
    scene.materials.resize(1);
    minirtc::Geometry geometry;
    geometry.bodies = {{"mesh", {}}};
    geometry.boundsMin = glm::vec3(oracle::kInfinity);
    geometry.boundsMax = glm::vec3(-oracle::kInfinity);
    for (const oracle::Triangle& triangle : mesh) {
        minirtc::Primitive primitive;
        primitive.p = triangle;
        geometry.primitives.push_back(primitive);
        for (const glm::vec3& p : triangle) {
            geometry.boundsMin = glm::min(geometry.boundsMin, p);
            geometry.boundsMax = glm::max(geometry.boundsMax, p);
        }
    }
    return modelOf(std::move(scene), std::move(geometry));
}

/// How hits in float compare with those in double. The edge functions err by a few units in the last place of the distance to the
/// triangle's vertices, so the float ray stands for all rays of a bundle of that radius: where they all agree, it must agree with
/// them; where they differ (at a silhouette or a crack of the mesh) it must lie within their range.
class Judge {
public:
    explicit Judge(const oracle::Mesh& mesh) : mesh_(mesh), scene_(mesh) {}

    struct Tally {
        size_t rays = 0;
        size_t hits = 0;
        size_t samePrimitive = 0;
        size_t sameDistance = 0;  // of another primitive
        size_t bundled = 0;       // differ, but so do the rays of the bundle
        size_t atOrigin = 0;      // the true hit is too near to the ray's origin to tell from one behind it
        size_t wrong = 0;
    };

    oracle::JudgedHit closestHit(const Ray& ray) const { return scene_.closestHit(ray); }

    /// Both miss, or both hit at the same distance.
    bool agree(const Ray& ray, const oracle::Hit& expected, const QueryHit& got) const {
        if (!got.hit() || expected.primitive == oracle::kNone) return got.primitive == expected.primitive;
        return std::abs(expected.t - got.t) <= errorOfT(ray, got.primitive);
    }

    void compare(const Ray& ray, const oracle::Hit& expected, const QueryHit& got, Tally& tally) const {
        tally.rays++;
        tally.hits += got.hit();
        if (agree(ray, expected, got)) {
            (expected.primitive == got.primitive ? tally.samePrimitive : tally.sameDistance)++;
        } else if (isInBundle(ray, expected, got)) {
            tally.bundled++;
        } else if (isAtOrigin(ray, expected) && isInBundle(ray, scene_.closestHit(past(ray, expected)), got)) {
            tally.atOrigin++;
        } else {
            tally.wrong++;
            INFO("expected primitive " << expected.primitive << " at " << expected.t << ", got " << got.primitive << " at "
                                       << got.t);
            INFO("origin " << ray.origin.x << " " << ray.origin.y << " " << ray.origin.z);
            INFO("direction " << ray.direction.x << " " << ray.direction.y << " " << ray.direction.z);
            if (tally.wrong <= 5) CHECK_MESSAGE(false, "a hit on the device differs from the one in double");
        }
    }

private:
    double distanceTo(const Ray& ray, uint32_t primitive) const {
        double distance = 0;
        for (const glm::vec3& p : mesh_[primitive])
            distance = std::max(distance, glm::distance(glm::dvec3(p), glm::dvec3(ray.origin)));
        return distance;
    }

    /// Bound of the error of a float hit's t: that of barycentrics (larger in thin triangles), seen along the ray (larger where
    /// it grazes).
    double errorOfT(const Ray& ray, uint32_t primitive) const {
        const glm::dvec3 a(mesh_[primitive][0]), u = glm::dvec3(mesh_[primitive][1]) - a, v = glm::dvec3(mesh_[primitive][2]) - a;
        const glm::dvec3 area = glm::cross(u, v), d(ray.direction);
        const double longest = std::max({glm::length(u), glm::length(v), glm::length(u - v)});
        const double aspect = longest * longest / glm::length(area);
        const double cosTheta = std::abs(glm::dot(area, d)) / (glm::length(area) * glm::length(d));
        return 16 * kEpsilon * distanceTo(ray, primitive) * aspect / (cosTheta * glm::length(d));
    }

    /// The origin lies on the triangle as far as float can tell at the distance of its vertices.
    bool isAtOrigin(const Ray& ray, const oracle::Hit& hit) const {
        return hit.primitive != oracle::kNone &&
               heightAbove(ray, hit.primitive) <= 16 * kEpsilon * distanceTo(ray, hit.primitive);
    }

    double heightAbove(const Ray& ray, uint32_t primitive) const {
        const glm::dvec3 a(mesh_[primitive][0]), u = glm::dvec3(mesh_[primitive][1]) - a, v = glm::dvec3(mesh_[primitive][2]) - a;
        return std::abs(glm::dot(glm::normalize(glm::cross(u, v)), glm::dvec3(ray.origin) - a));
    }

    static Ray past(Ray ray, const oracle::Hit& hit) {
        ray.tMin = std::nextafter(static_cast<float>(hit.t), oracle::kInfinity);
        return ray;
    }

    bool isInBundle(const Ray& ray, const oracle::Hit& expected, const QueryHit& got) const {
        double distance = 0;
        for (uint32_t primitive : {expected.primitive, got.primitive})
            if (primitive != oracle::kNone) distance = std::max(distance, distanceTo(ray, primitive));
        const glm::dvec3 d(ray.direction);
        const glm::dvec3 u =
            glm::normalize(glm::cross(d, std::abs(d.x) < std::abs(d.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::normalize(glm::cross(d, u));
        double nearest = expected.t, farthest = expected.t;
        for (int i = 0; i < 16; ++i) {
            const double angle = i * 0.78539816339744831, error = (i % 2 ? 8 : 24) * kEpsilon;
            const glm::dvec3 aside = u * std::cos(angle) + v * std::sin(angle);
            Ray shifted = ray;
            if (i < 8)
                shifted.origin = glm::vec3(glm::dvec3(ray.origin) + aside * error * distance);
            else
                shifted.direction = glm::vec3(d + aside * error * glm::length(d));
            const oracle::Hit hit = scene_.closestHit(shifted);
            nearest = std::min(nearest, hit.t);
            farthest = std::max(farthest, hit.t);
        }
        const double t = got.hit() ? got.t : std::numeric_limits<double>::infinity();
        const double error = got.hit() ? errorOfT(ray, got.primitive) : 0;
        return t >= nearest - error && t <= farthest + error;
    }

    const oracle::Mesh& mesh_;
    oracle::DoubleScene scene_;
};

void report(const std::string& what, const Judge::Tally& tally) {
    MESSAGE(what << ": " << tally.rays << " rays, " << tally.hits << " hits; same primitive " << tally.samePrimitive
                 << ", same distance " << tally.sameDistance << ", within the bundle " << tally.bundled << ", wrong "
                 << tally.wrong);
}

struct RayKind {
    const char* name;
    std::vector<Ray> (*make)(const oracle::Mesh&, size_t, uint32_t);
};
const RayKind kRayKinds[] = {{"random", oracle::randomRays},
                             {"axis-parallel", oracle::axisParallelRays},
                             {"edge-aimed", oracle::edgeRays},
                             {"vertex-aimed", oracle::vertexRays}};
const LayoutChoice kLayouts[] = {LayoutChoice::quantised, LayoutChoice::floating};

void compareWithDouble(GpuContext& gpu, const Model& model, const std::vector<Ray>& rays, const std::string& what) {
    INFO(what);
    const Judge judge(model.mesh);
    std::vector<oracle::Hit> expected;
    for (const Ray& ray : rays) expected.push_back(judge.closestHit(ray));
    std::vector<QueryHit> hits[2];
    for (int i = 0; i < 2; ++i) {
        RayQuery query(gpu.get(), model.scene, model.geometry, kLayouts[i]);
        hits[i] = query.trace(rays, QueryMode::closest);
        Judge::Tally tally;
        for (size_t k = 0; k < rays.size(); ++k) judge.compare(rays[k], expected[k], hits[i][k], tally);
        report(what, tally);
        CHECK(tally.wrong == 0);
        CHECK(tally.bundled * 20 <= tally.rays);
    }
    for (size_t k = 0; k < rays.size(); ++k) REQUIRE(hits[0][k].t == hits[1][k].t);
}

void compareWithDouble(const std::string& name) {
    if (!test::haveShared("scenes/real/meshes/" + name)) return;
    GpuContext gpu;
    if (!gpu) return;
    const Model model = load(name);
    for (const RayKind& kind : kRayKinds) compareWithDouble(gpu, model, kind.make(model.mesh, 20000, 1), kind.name);
}

/// From just above random hits into all directions, as mirrors and shadows send them.
std::vector<Ray> raysFromSurface(const oracle::Mesh& mesh, const std::vector<Ray>& rays, const std::vector<QueryHit>& hits) {
    std::vector<Ray> from;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].hit()) continue;
        const oracle::Triangle& triangle = mesh[hits[i].primitive];
        const glm::vec3 p = rays[i].origin + hits[i].t * rays[i].direction;
        const glm::vec3 ng = glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
        const glm::vec3 towards = rays[(i * 7919 + 1) % rays.size()].origin;  // as good as random
        const glm::vec3 d = glm::normalize(towards - p);
        const float lift = 1e-3f * glm::distance(p, towards);
        from.push_back({p + lift * (glm::dot(ng, d) < 0 ? -ng : ng), 0, d, oracle::kInfinity});
    }
    return from;
}

void compareWithEmbree(const std::string& name) {
    if (!test::haveShared("scenes/real/meshes/" + name)) return;
    if (!EmbreeScene::available()) return test::skip("needs Embree 3");
    GpuContext gpu;
    if (!gpu) return;
    const Model model = load(name);
    const EmbreeScene embree(model.mesh, EmbreeScene::Mode::robust);
    const Judge judge(model.mesh);
    for (LayoutChoice layout : kLayouts) {
        RayQuery query(gpu.get(), model.scene, model.geometry, layout);
        size_t compared = 0, same = 0, sameDistance = 0;
        Judge::Tally differing;
        const auto compare = [&](const std::vector<Ray>& rays) {
            const std::vector<QueryHit> hits = query.trace(rays, QueryMode::closest);
            for (size_t i = 0; i < rays.size(); ++i) {
                const oracle::Hit hit = oracle::closestHit(embree, rays[i]);
                compared++;
                if (!judge.agree(rays[i], hit, hits[i]))
                    judge.compare(rays[i], judge.closestHit(rays[i]), hits[i], differing);
                else
                    (hit.primitive == hits[i].primitive ? same : sameDistance)++;
            }
            return hits;
        };
        const std::vector<Ray> random = oracle::randomRays(model.mesh, 400000, 7);
        compare(raysFromSurface(model.mesh, random, compare(random)));
        compare(oracle::axisParallelRays(model.mesh, 200000, 8));
        MESSAGE(compared << " rays: same primitive as Embree " << same << ", same distance " << sameDistance << ", other "
                         << differing.rays << " (right by the judge in double " << differing.rays - differing.wrong << ")");
        CHECK(compared >= 700000);
        CHECK(differing.wrong == 0);
        CHECK(differing.rays * 1000 <= compared);
    }
}

oracle::Mesh join(oracle::Mesh a, const oracle::Mesh& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// 2 n^2 triangles in the plane y = 0 over [-1,1]^2.
oracle::Mesh flatGrid(int n) {
    oracle::Mesh mesh;
    const auto at = [n](int x, int z) { return glm::vec3(2.0f * x / n - 1, 0, 2.0f * z / n - 1); };
    for (int z = 0; z < n; ++z)
        for (int x = 0; x < n; ++x) {
            mesh.push_back({at(x, z), at(x, z + 1), at(x + 1, z + 1)});
            mesh.push_back({at(x, z), at(x + 1, z + 1), at(x + 1, z)});
        }
    return mesh;
}

void compareAllKinds(GpuContext& gpu, const Model& model, const oracle::Mesh& aim, size_t count) {
    for (const RayKind& kind : kRayKinds) compareWithDouble(gpu, model, kind.make(aim, count, 3), kind.name);
}

}  // namespace

TEST_CASE("the bunny: closest hits equal those in double") {
    compareWithDouble("scans/stanford-bunny.obj");
}
TEST_CASE("the dragon: closest hits equal those in double") {
    compareWithDouble("scans/stanford-dragon-res3.obj");
}
TEST_CASE("the rocker arm: closest hits equal those in double") {
    compareWithDouble("scans/rocker-arm.obj");
}
TEST_CASE("the fandisk: closest hits equal those in double") {
    compareWithDouble("classic/fandisk.obj");
}
TEST_CASE("the teapot: closest hits equal those in double") {
    compareWithDouble("classic/teapot.obj");
}

TEST_CASE("the bunny: closest hits equal those of Embree") {
    compareWithEmbree("scans/stanford-bunny.obj");
}
TEST_CASE("the armadillo: closest hits equal those of Embree") {
    compareWithEmbree("scans/armadillo.obj");
}

TEST_CASE("any hit exists exactly where a closest one does") {
    GpuContext gpu;
    if (!gpu) return;
    const Model model = modelOf(join(oracle::icosphere({0, 0, 0}, 1, 4), oracle::icosphere({1.5f, 0.2f, 0}, 0.7f, 4)));
    for (LayoutChoice layout : kLayouts) {
        RayQuery query(gpu.get(), model.scene, model.geometry, layout);
        for (const RayKind& kind : kRayKinds) {
            INFO(kind.name);
            const std::vector<Ray> rays = kind.make(model.mesh, 20000, 5);
            const std::vector<QueryHit> closest = query.trace(rays, QueryMode::closest);
            const auto endingAt = [&](const auto& end) {
                std::vector<Ray> ended = rays;
                for (size_t i = 0; i < rays.size(); ++i) ended[i].tMax = end(closest[i]);
                return query.trace(ended, QueryMode::any);
            };
            const auto unlimited = endingAt([](const QueryHit&) { return oracle::kInfinity; });
            const auto upToHit = endingAt([](const QueryHit& hit) { return hit.t; });
            const auto pastHit = endingAt([](const QueryHit& hit) { return std::nextafter(hit.t, oracle::kInfinity); });
            size_t hits = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                REQUIRE(unlimited[i].hit() == closest[i].hit());
                REQUIRE(!upToHit[i].hit());
                REQUIRE(pastHit[i].hit() == closest[i].hit());
                hits += closest[i].hit();
            }
            CHECK(hits > rays.size() / 3);
        }
    }
}

TEST_CASE("no ray at an edge or vertex of a closed mesh gets inside") {
    GpuContext gpu;
    if (!gpu) return;
    for (const glm::vec3& center : {glm::vec3(0), glm::vec3(1e3f, -2e3f, 5e2f)}) {
        const Model model = modelOf(oracle::icosphere(center, 1, 5));
        for (LayoutChoice layout : kLayouts) {
            RayQuery query(gpu.get(), model.scene, model.geometry, layout);
            for (const auto make : {oracle::edgeRays, oracle::vertexRays}) {
                const std::vector<Ray> rays = make(model.mesh, 200000, 9);
                const std::vector<QueryHit> hits = query.trace(rays, QueryMode::closest);
                size_t leaks = 0;
                for (size_t i = 0; i < rays.size(); ++i) {
                    const glm::dvec3 d(rays[i].direction), o = glm::dvec3(rays[i].origin) - glm::dvec3(center);
                    const double along = -glm::dot(o, d) / glm::dot(d, d);
                    const double passes = glm::length(o + along * d);
                    // The front half ends where the line is nearest to the centre; the silhouette is left out.
                    if (passes < 0.99) leaks += !hits[i].hit() || hits[i].t > along;
                }
                CHECK(leaks == 0);
            }
        }
    }
}

TEST_CASE("a tiny ball on a plane of ten kilometres") {
    GpuContext gpu;
    if (!gpu) return;
    const float size = 5000;
    const oracle::Mesh plane = {{glm::vec3(-size, 0, -size), glm::vec3(-size, 0, size), glm::vec3(size, 0, size)},
                                {glm::vec3(-size, 0, -size), glm::vec3(size, 0, size), glm::vec3(size, 0, -size)}};
    const oracle::Mesh ball = oracle::icosphere({30, 0.05f, -40}, 0.05f, 3);
    const Model model = modelOf(join(plane, ball));
    compareAllKinds(gpu, model, ball, 4000);
}

TEST_CASE("meshes two thousand kilometres apart") {
    if (!test::haveShared("scenes/real/meshes/classic/suzanne.obj")) return;
    GpuContext gpu;
    if (!gpu) return;
    minirtc::Transform here, there;
    here.scale = there.scale = glm::dvec3(1000);
    here.translate = glm::dvec3(-1e6);
    there.translate = glm::dvec3(1e6);
    const Model model = load("classic/suzanne.obj", {here, there});
    CHECK(model.geometry.boundsMax.x > 9e5f);
    const oracle::Mesh aim(model.mesh.begin() + static_cast<ptrdiff_t>(model.mesh.size() / 2), model.mesh.end());
    compareAllKinds(gpu, model, aim, 10000);
}

TEST_CASE("a mesh moved by a thousand kilometres keeps its shape") {
    if (!test::haveShared("scenes/real/meshes/classic/suzanne.obj")) return;
    GpuContext gpu;
    if (!gpu) return;
    minirtc::Transform moved;
    moved.translate = glm::dvec3(1e6, -1e6, 1e6);
    const Model model = load("classic/suzanne.obj", {moved}), unmoved = load("classic/suzanne.obj");
    REQUIRE(model.mesh.size() == unmoved.mesh.size());
    CHECK(glm::distance(model.geometry.origin, unmoved.geometry.origin + moved.translate) < 1e-9);
    const std::vector<Ray> rays = oracle::randomRays(unmoved.mesh, 20000, 2);
    const Judge judge(unmoved.mesh);
    RayQuery query(gpu.get(), model.scene, model.geometry, LayoutChoice::automatic);
    const std::vector<QueryHit> hits = query.trace(rays, QueryMode::closest);
    Judge::Tally tally;
    for (size_t i = 0; i < rays.size(); ++i) judge.compare(rays[i], judge.closestHit(rays[i]), hits[i], tally);
    report("moved", tally);
    CHECK(tally.wrong == 0);
    CHECK(tally.bundled < 10);
}

TEST_CASE("rays from a thousand kilometres away") {
    GpuContext gpu;
    if (!gpu) return;
    const Model model = modelOf(oracle::icosphere({0, 0, 0}, 1000, 3));
    for (const RayKind& kind : kRayKinds) {
        std::vector<Ray> rays = kind.make(model.mesh, 5000, 3);
        for (Ray& ray : rays) ray.origin -= glm::normalize(ray.direction) * 1e6f;
        compareWithDouble(gpu, model, rays, kind.name);
    }
}

TEST_CASE("millimetre faces are hit from kilometres away") {
    GpuContext gpu;
    if (!gpu) return;
    oracle::Mesh mesh = flatGrid(64);
    for (oracle::Triangle& triangle : mesh)
        for (glm::vec3& p : triangle) p *= 0.032f;
    const Model model = modelOf(mesh);
    std::vector<Ray> rays;
    for (int i = 0; i < 1000; ++i) {
        const float angle = 1.5f * static_cast<float>(i) / 1000;  // up to 86 degrees off the normal
        const glm::vec3 d(std::sin(angle), -std::cos(angle), 0);
        rays.push_back({-3000.0f * d, 0, d, oracle::kInfinity});
    }
    for (LayoutChoice layout : kLayouts) {
        RayQuery query(gpu.get(), model.scene, model.geometry, layout);
        for (const QueryHit& hit : query.trace(rays, QueryMode::closest)) CHECK(hit.t == doctest::Approx(3000).epsilon(1e-5));
    }
}

TEST_CASE("a flat scene is hit across its plane and missed along it") {
    GpuContext gpu;
    if (!gpu) return;
    const Model model = modelOf(flatGrid(32));
    compareAllKinds(gpu, model, model.mesh, 5000);
    std::vector<Ray> along;
    for (int i = 0; i < 64; ++i) {
        const float z = static_cast<float>(i) / 32 - 1;
        along.push_back({{-3, 0, z}, 0, {1, 0, 0}, oracle::kInfinity});
        along.push_back({{-3, 0, z}, 0, {1, 0, 0.25f}, oracle::kInfinity});
        along.push_back({{z, 0, 0.1f}, 0, {0, 0, -1}, oracle::kInfinity});  // starts within
    }
    std::vector<Ray> down = along;
    for (Ray& ray : down) ray.origin = {ray.origin.z, 2, ray.origin.z}, ray.direction = {0, -4, 0};
    for (LayoutChoice layout : kLayouts) {
        RayQuery query(gpu.get(), model.scene, model.geometry, layout);
        for (const QueryHit& hit : query.trace(along, QueryMode::closest)) CHECK(!hit.hit());
        for (const QueryHit& hit : query.trace(down, QueryMode::closest)) CHECK(hit.t == 0.5f);
    }
}

TEST_CASE("more rays than a dispatch takes and numbers that fill no group") {
    GpuContext gpu;
    if (!gpu) return;
    const Model model = modelOf({{glm::vec3(-1, -1, 0), glm::vec3(1, -1, 0), glm::vec3(0, 1, 0)}});
    RayQuery query(gpu.get(), model.scene, model.geometry, LayoutChoice::automatic);
    for (size_t count : {size_t{1}, size_t{63}, size_t{65}, size_t{300001}}) {
        std::vector<Ray> rays;
        for (size_t i = 0; i < count; ++i)
            rays.push_back({{0, 0, static_cast<float>(i + 1)}, 0, {0, 0, i % 3 ? -1.0f : 1.0f}, 1e6f});
        const std::vector<QueryHit> hits = query.trace(rays, QueryMode::closest);
        REQUIRE(hits.size() == count);
        for (size_t i = 0; i < count; ++i) {
            REQUIRE(hits[i].hit() == (i % 3 != 0));
            REQUIRE(hits[i].t == (i % 3 ? static_cast<float>(i + 1) : 1e6f));
        }
    }
    CHECK(query.stats().dispatches > 1);
}

TEST_CASE("rays that are suspended find the same hits") {
    const Model model = modelOf(join(oracle::icosphere({0, 0, 0}, 1, 4), oracle::icosphere({1.5f, 0.2f, 0}, 0.7f, 4)));
    const std::vector<Ray> rays = oracle::randomRays(model.mesh, 5000, 6);
    std::vector<QueryHit> whole;
    for (const uint32_t steps : {0u, 1u, 5u, 17u}) {
        CAPTURE(steps);
        GpuContext gpu;
        if (!gpu) return;
        if (steps) test::setStepBudget(gpu.get(), steps);
        RayQuery query(gpu.get(), model.scene, model.geometry, LayoutChoice::automatic);
        const std::vector<QueryHit> hits = query.trace(rays, QueryMode::closest);
        CHECK((query.stats().resumed > 0) == (steps > 0));
        if (steps == 0) whole = hits;
        for (size_t i = 0; i < rays.size(); ++i) REQUIRE((hits[i].t == whole[i].t && hits[i].primitive == whole[i].primitive));
    }
}
