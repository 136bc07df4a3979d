// The work that kernels count for minirt-bench --profile: closed forms, and a walk of the same nodes on the processor.
#include <doctest/doctest.h>

#include <cmath>

#include "gpu_context.hpp"
#include "meshes.hpp"
#include "ray_profile.hpp"
#include "shader_source.hpp"

using namespace bench;
using test::GpuContext;

namespace {

constexpr size_t kGroup = 64;

/// Triangles exactly as given, not recentred.
Mesh meshOf(const Triangles& triangles) {
    Mesh mesh{"mesh", {}, {}, triangles};
    mesh.scene.materials.resize(1);
    mesh.geometry.bodies = {{"mesh", {}}};
    minirtc::Aabb box;
    for (const Triangle& triangle : triangles) {
        minirtc::Primitive primitive;
        primitive.p = triangle;
        mesh.geometry.primitives.push_back(primitive);
        for (const glm::vec3& p : triangle) box.grow(p);
    }
    mesh.geometry.boundsMin = box.lo;
    mesh.geometry.boundsMax = box.hi;
    return mesh;
}

/// Kernels with and without counting over one mesh.
struct Kernels {
    minirtc::Bvh bvh;
    RayKernel timed, counting;

    Kernels(const GpuContext& gpu, const Mesh& mesh, minirtc::LayoutChoice layout)
        : bvh(minirtc::buildBvh(mesh.geometry, 0, minirtc::BvhQuality::fast)),
          timed(gpu.get(), {mesh.scene, mesh.geometry, bvh, layout}),
          counting(gpu.get(), {mesh.scene, mesh.geometry, bvh, layout}, RayKernel::Counting::on) {}

    /// What the kernel counts, having found what the other one finds.
    std::vector<RayWork> trace(const std::vector<Ray>& rays, bool anyHit) {
        for (RayKernel* kernel : {&timed, &counting}) {
            kernel->setRays(rays);
            kernel->trace(anyHit);
        }
        CHECK(agreement(timed.hits(), counting.hits(), false, 0).differing() == 0);
        return counting.work();
    }

    RayProfile profile(const std::vector<Ray>& rays) {
        return profileOf(trace(rays, false), rays.size(), counting.nodeBytes(), counting.primitiveBytes());
    }
};

Ray down(float x, float z) {
    return {glm::vec3(x, 3, z), 0, glm::vec3(0, -1, 0), kRayEnd};
}

const Triangles kTriangle = {{glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 0)}};

/// As slender as they come, along the diagonal of the unit cube: the box of each is nearly the whole cube.
Triangles needles(size_t count) {
    Triangles all;
    for (size_t i = 0; i < count; ++i) {
        const auto n = static_cast<double>(i);
        const auto x = static_cast<float>(1e-3 * std::fmod(n * 0.7548776662466927, 1.0));
        const auto y = static_cast<float>(1e-3 * std::fmod(n * 0.5698402909980532, 1.0));
        all.push_back({glm::vec3(x, y, 0), glm::vec3(1 + x, 1 + y, 1), glm::vec3(1 + x + 1e-5f, 1 + y, 1)});
    }
    return all;
}

/// One ray over the nodes of a blob, one at a time.
class Walk {
public:
    Walk(const minirtc::EncodedNodes& nodes, const minirtc::Bvh& bvh, const Triangles& triangles)
        : nodes_(nodes), bvh_(bvh), triangles_(triangles) {}

    RayWork operator()(const Ray& ray, bool anyHit) const {
        const f32::GridRay gridRay =
            f32::gridRay(f32::slabRay(ray.origin, ray.direction, nodes_.gridOrigin, nodes_.gridScale, nodes_.gridPlanes));
        const f32::Shear shear = f32::shearOf(ray.direction);
        RayWork work = {};
        float t = ray.tMax;
        std::vector<uint32_t> open = {0};
        while (!open.empty()) {
            const uint32_t node = open.back();
            open.pop_back();
            if (!(node & MINIRT_LEAF)) {
                work.nodeSteps++;
                step(gridRay, node, t, open);
            } else if (leaf(ray, shear, node, t, work) && anyHit) {
                break;
            }
        }
        return work;
    }

private:
    void step(const f32::GridRay& ray, uint32_t node, float t, std::vector<uint32_t>& open) const {
        f32::BoxHit hit[2];
        uint32_t reference[2];
        for (int i = 0; i < 2; ++i) {
            const uint32_t* w = nodes_.words.data() + node * 8 + static_cast<size_t>(i) * 4;
            hit[i] = f32::intersectGridBox(ray, {w[0], w[1], w[2]}, t);
            reference[i] = w[3];
        }
        const int near = hit[1].hit && (hit[1].tNear < hit[0].tNear || !hit[0].hit);
        for (const int i : {1 - near, near})
            if (hit[i].hit) open.push_back(reference[i]);
    }

    bool leaf(const Ray& ray, const f32::Shear& shear, uint32_t node, float& t, RayWork& work) const {
        bool found = false;
        work.leaves++;
        const uint32_t first = (node & ~MINIRT_LEAF) >> 3;
        for (uint32_t slot = first; slot <= first + (node & 7u); ++slot) {
            const Triangle& v = triangles_[bvh_.order[slot]];
            const f32::TriangleHit hit = f32::intersectTriangle(ray.origin, shear, v[0], v[1], v[2], t);
            work.triangleTests++;
            if (hit.hit) t = hit.t;
            found = found || hit.hit;
        }
        return found;
    }

    const minirtc::EncodedNodes& nodes_;
    const minirtc::Bvh& bvh_;
    const Triangles& triangles_;
};

bool sameWork(const RayWork& a, const RayWork& b) {
    return a.nodeSteps == b.nodeSteps && a.triangleTests == b.triangleTests && a.leaves == b.leaves;
}

}  // namespace

TEST_CASE("a triangle takes a node step, and a test where its box is met") {
    GpuContext gpu;
    if (!gpu) return;
    Kernels kernels(gpu, meshOf(kTriangle), minirtc::LayoutChoice::quantised);
    std::vector<Ray> rays(kGroup, down(5, 5));
    rays[0] = down(0.25f, 0.25f);
    const RayProfile profile = kernels.profile(rays);
    CHECK(kernels.timed.hits()[0].primitive == 0);
    CHECK(profile.nodeSteps.mean == 1);
    CHECK(profile.nodeSteps.most == 1);
    CHECK(profile.triangleTests.mean == 1.0 / kGroup);
    CHECK(profile.triangleTests.most == 1);
    CHECK(profile.nodeBytes == 32);
    CHECK(profile.triangleBytes == 48.0 / kGroup);
    // All lanes take the node step. One alone tests; where lanes are masked, the other subgroups run that test for nobody.
    CHECK(profile.nodeLanes.inUse == 1);
    CHECK(profile.nodeLanes.empty == 0);
    const double subgroups = static_cast<double>(kGroup) / profile.subgroupSize;
    const double passes = gpu.isCpu() ? subgroups : 1;
    CHECK(profile.triangleLanes.inUse == doctest::Approx(1 / (passes * profile.subgroupSize)));
    CHECK(profile.triangleLanes.empty == doctest::Approx((passes - 1) / passes));
    CHECK(profile.triangleLanes.bound == 1.0 / profile.subgroupSize);
}

TEST_CASE("the device's work is that of a walk over the blob's nodes") {
    GpuContext gpu;
    if (!gpu) return;
    const Mesh knot = knotMesh(2000);
    Kernels kernels(gpu, knot, minirtc::LayoutChoice::quantised);
    const minirtc::EncodedNodes nodes = minirtc::quantiseNodes(kernels.bvh, knot.geometry);
    const Walk walk(nodes, kernels.bvh, knot.triangles);
    std::vector<Ray> rays = primaryRays(surroundingsOf(knot.triangles), 64, 64);
    kernels.trace(rays, false);
    const SecondaryRays secondary = secondaryRays(knot.triangles, rays, kernels.timed.hits(), 1, 1);
    rays.insert(rays.end(), secondary.diffuse.begin(), secondary.diffuse.end());
    for (const bool anyHit : {false, true}) {
        const std::vector<RayWork> work = kernels.trace(rays, anyHit);
        size_t differing = 0, steps = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            differing += !sameWork(work[i], walk(rays[i], anyHit));
            steps += work[i].nodeSteps;
        }
        CHECK(steps > 5 * rays.size());
        CHECK(
            differing <=
            (gpu.isCpu() ? 0 : rays.size() / 100));  // a GPU contracts products and sums, which moves boxes by up to half a plane
    }
}

TEST_CASE("lanes are full where all rays are one, and no subgroup takes fewer passes than its longest ray") {
    GpuContext gpu;
    if (!gpu) return;
    const Mesh knot = knotMesh(2000);
    Kernels kernels(gpu, knot, minirtc::LayoutChoice::automatic);
    const std::vector<Ray> rays = primaryRays(surroundingsOf(knot.triangles), 64, 64);
    const std::vector<RayWork> work = kernels.trace(rays, false);
    const auto longest = std::max_element(work.begin(), work.end(),
                                          [](const RayWork& a, const RayWork& b) { return a.triangleTests < b.triangleTests; });
    const RayProfile one = kernels.profile(std::vector<Ray>(2 * kGroup, rays[static_cast<size_t>(longest - work.begin())]));
    CHECK(one.nodeSteps.mean == longest->nodeSteps);
    CHECK(one.nodeLanes.inUse == 1);
    CHECK(one.triangleLanes.inUse >=
          longest->triangleTests / (longest->triangleTests + 1.0));  // the walk may end with an empty pass
    const RayProfile all = profileOf(work, rays.size(), 32, 48);
    for (const LoopLanes& lanes : {all.nodeLanes, all.triangleLanes}) {
        CHECK(lanes.inUse > 1.0 / all.subgroupSize);
        CHECK(lanes.inUse <= lanes.bound);
        CHECK(lanes.bound < 1);
    }
}

TEST_CASE("what a ray does in several dispatches counts together") {
    GpuContext gpu;
    if (!gpu) return;
    constexpr size_t kNeedles = 10000;  // more steps than a CPU device takes in a dispatch
    Kernels kernels(gpu, meshOf(needles(kNeedles)), minirtc::LayoutChoice::floating);
    const RayProfile profile =
        kernels.profile(std::vector<Ray>(kGroup, {glm::vec3(0.6f, 0.4f, -1), 0, glm::vec3(0, 0, 1), kRayEnd}));
    CHECK(kernels.timed.hits()[0].primitive == kNoHit);
    CHECK(profile.nodeSteps.mean == static_cast<double>(kernels.bvh.nodes.size()));
    CHECK(profile.triangleTests.mean == static_cast<double>(kernels.bvh.order.size()));
    CHECK(profile.leaves.mean == kernels.bvh.leaves);
    CHECK(profile.nodeBytes == 64 * profile.nodeSteps.mean);
    if (gpu.isCpu()) CHECK(profile.nodeSteps.mean + profile.triangleTests.mean > 65535.0 / profile.subgroupSize);
}

TEST_CASE("a profile's figures follow from the counts, idle rays in passes alone") {
    std::vector<RayWork> work(192, {2, 1, 1, 4, 0, 0, 0, 0});
    work[0].nodeSteps = 10;  // with rays 1, 8 and 9 in a subgroup of four, since lanes lie in Morton order
    work[8].nodeSteps = 6;
    work[2].nodeSteps = 5;
    work[0].nodePasses = 150, work[191].nodePasses = 30, work[1].emptyNodePasses = 20;
    work[0].trianglePasses = 50;
    const RayProfile profile = profileOf(work, 190, 32, 48);
    const double steps = 187 * 2 + 10 + 6 + 5;
    CHECK(profile.nodeSteps.mean == doctest::Approx(steps / 190));
    CHECK(profile.nodeSteps.percentile99 == 6);
    CHECK(profile.nodeSteps.most == 10);
    CHECK(profile.nodeBytes == doctest::Approx(32 * steps / 190));
    CHECK(profile.triangleBytes == 48);
    CHECK(profile.nodeLanes.inUse == doctest::Approx(steps / (4 * 200)));
    CHECK(profile.nodeLanes.bound == doctest::Approx(steps / (4 * (10 + 5 + 46 * 2))));
    CHECK(profile.nodeLanes.passes == doctest::Approx(200.0 / 190));
    CHECK(profile.nodeLanes.empty == doctest::Approx(0.1));
    CHECK(profile.triangleLanes.inUse == doctest::Approx(190.0 / 200));
    CHECK(profile.triangleLanes.bound == doctest::Approx(190.0 / 192));
    CHECK(profile.triangleLanes.empty == 0);
    CHECK(profileOf({}, 0, 32, 48).nodeSteps.mean == 0);
}

TEST_CASE("only kernels that count hold what counts") {
    minirtc::EffectSet effects;
    effects[minirtc::Effect::triangles].included = true;
    for (const char* name : {"rays", "rays_once"}) {
        effects.profile = false;
        const minirtc::Kernel timed = minirtc::compileKernel(name, effects);
        effects.profile = true;
        const minirtc::Kernel counting = minirtc::compileKernel(name, effects);
        CHECK(counting.bindings == (timed.bindings | 1u << MINIRT_BINDING_QUEUES));
        CHECK((timed.bindings >> MINIRT_BINDING_QUEUES & 1u) == 0);
        CHECK(timed.spirv.size() < counting.spirv.size());
    }
}
