// Whitted's trees that lanes share: the same rays and, but for how sums round, the same picture as pixel by pixel.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "error.hpp"
#include "host_device.hpp"
#include "render_scene.hpp"
#include "runtime_hooks.hpp"

using test::GpuContext;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

/// Water around the camera, ice that overlaps it, a pane, a ball that mirrors, two lights; `more` of "render", `members` of the scene.
std::string nested(const std::string& more = "", const std::string& members = "") {
    const std::string clear = R"({"model":"pbr","roughness":0,"transmission":1,)";
    return "{" + members + R"("camera":{"position":[0.3,0.2,0.9],"target":[0,0,-1],"vfov":70},"background":{"color":[0.5,0.7,1]},
        "lights":[{"type":"point","position":[-0.5,0.6,0],"intensity":[3,3,3]},{"type":"directional","direction":[1,-2,-1],"irradiance":[1,1,1]}],
        "materials":{"water":)" +
           clear + R"("ior":1.33,"attenuationColor":[0.3,0.8,0.9],"inscatter":0.3},"ice":)" + clear +
           R"("glass":"ice"},"pane":)" + clear + R"("thin":true},"fish":{"model":"phong","diffuse":0.6,"reflect":0.3}},
        "objects":[{"sphere":{"center":[0,0,0],"radius":2},"material":"water"},{"sphere":{"center":[0,0,-1.8],"radius":0.7},"material":"ice"},
                   {"sphere":{"center":[0.4,0,1.2],"radius":0.8},"material":"ice"},{"sphere":{"center":[-0.5,-0.3,-0.6],"radius":0.3},"material":"fish"},
                   {"rectangle":{"origin":[-1,-1,-0.2],"u":[2,0,0],"v":[0,0.6,-0.5]},"material":"pane"},
                   {"rectangle":{"origin":[-9,-2.5,9],"u":[18,0,0],"v":[0,0,-18]},"material":"fish"}],
        "render":{"integrators":["whitted","whitted_shared"],"size":[20,12],"maxDepth":)" +
           (more.find("spectral") < more.size() ? "4" : "6") + more + "}}";
}

/// Glass and mirrors on a matt floor, without volumes that touch.
std::string balls() {
    return R"({"camera":{"position":[0,2,5],"target":[0,0,0],"vfov":45},"background":{"color":[0.2,0.3,0.5]},
        "lights":[{"type":"point","position":[3,4,2],"intensity":[20,20,20]}],
        "materials":{"glass":{"model":"pbr","roughness":0,"transmission":1},"mirror":{"model":"phong","diffuse":0.1,"reflect":0.8},
                     "matt":{"model":"phong","color":[0.7,0.3,0.2]}},
        "objects":[{"rectangle":{"origin":[-6,0,-6],"u":[0,0,12],"v":[12,0,0]},"material":"matt"},
                   {"sphere":{"center":[-0.6,0.6,0],"radius":0.5},"material":"glass"},{"sphere":{"center":[0.7,0.6,0.2],"radius":0.5},"material":"mirror"},
                   {"sphere":{"center":[0.1,0.4,1.2],"radius":0.3},"material":"glass"}],
        "render":{"integrators":["whitted","whitted_shared"],"size":[40,28],"maxDepth":8}})";
}

minirt_render_desc with(minirt_integrator integrator, minirt_render_desc desc = {}) {
    desc.integrator = integrator;
    return desc;
}

/// Of all channels, the largest difference in units of 1 + the channel.
double apart(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    double most = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        REQUIRE(std::isfinite(a.rgba[i]));
        most = std::max(most, static_cast<double>(std::abs(a.rgba[i] - b.rgba[i]) / (1 + std::abs(b.rgba[i]))));
    }
    return most;
}

/// Both forms of one scene: the same rays, and sums that differ by their rounding alone. On a GPU other code rounds otherwise on the way, too.
void checkBoth(const GpuContext& gpu, const LoadedScene& scene, const minirt_render_desc& desc = {}) {
    const Picture alone = scene.render(with(MINIRT_INTEGRATOR_WHITTED, desc));
    const Picture shared = scene.render(with(MINIRT_INTEGRATOR_WHITTED_SHARED, desc));
    CHECK(apart(shared, alone) <= (gpu.isCpu() ? 1e-6 : 1e-3));
    const auto alike = [&](uint64_t a, uint64_t b) { return gpu.isCpu() ? a == b : std::abs(double(a) / double(b) - 1) < 0.01; };
    CHECK(alike(shared.stats.shadow_rays, alone.stats.shadow_rays));
    CHECK(alike(shared.stats.secondary_rays, alone.stats.secondary_rays));
    CHECK(shared.stats.secondary_rays > 0);
}

std::filesystem::path bakeBoth(const TemporaryDir& dir, const std::string& json) {
    return test::bakeScene(dir, json, minirtc::LayoutChoice::automatic, test::Kernels::ofAll);
}

}  // namespace

TEST_CASE("shared trees have the rays and the sums of those that a lane follows alone") {
    const std::string cases[] = {
        balls(),
        nested(),
        nested(R"(,"spp":3)", R"("nesting":"parity",)"),
        nested(R"(,"dispersionMode":"spectral")"),
        nested(R"(,"accuracy":{"weak_rays":"roulette"})"),
        nested(R"(,"accuracy":{"nesting":"off"})"),
        nested(R"(,"accuracy":{"precision":"double"})"),
    };
    const TemporaryDir dir;
    for (const std::string& json : cases) {
        GpuContext gpu;
        if (!gpu) return;
        test::allowSharedTrees(gpu.get());
        CAPTURE(json);
        checkBoth(gpu, LoadedScene(gpu, bakeBoth(dir, json)));
    }
}

TEST_CASE("a shared tree's picture is the same bit for bit whoever traces what") {
    const TemporaryDir dir;
    const auto blob = bakeBoth(dir, nested());
    GpuContext gpu;
    if (!gpu) return;
    test::allowSharedTrees(gpu.get());
    const LoadedScene scene(gpu, blob);
    const Picture first = scene.render(with(MINIRT_INTEGRATOR_WHITTED_SHARED));
    for (int again = 0; again < 3; ++again) CHECK(scene.render(with(MINIRT_INTEGRATOR_WHITTED_SHARED)) == first);
    if (!gpu.isCpu()) return;
    for (const uint32_t steps : {40u, 400u}) {  // subgroups leave, and others go on with what they had
        CAPTURE(steps);
        GpuContext hasty;
        test::allowSharedTrees(hasty.get());
        test::setStepBudget(hasty.get(), steps);
        const Picture picture = LoadedScene(hasty, blob).render(with(MINIRT_INTEGRATOR_WHITTED_SHARED));
        CHECK(picture == first);
        CHECK(picture.stats.secondary_rays == first.stats.secondary_rays);
        CHECK((steps > 40 || picture.stats.resumed_dispatches > 0));
    }
}

TEST_CASE("shared trees know regions, depths, cut-offs and several samples") {
    const TemporaryDir dir;
    GpuContext gpu;
    if (!gpu) return;
    test::allowSharedTrees(gpu.get());
    const LoadedScene scene(gpu, bakeBoth(dir, nested()));
    minirt_render_desc region = {};
    region.region = {3, 2, 11, 7};
    minirt_render_desc deep = {};
    deep.max_depth = 25;
    deep.samples = 2;
    minirt_render_desc weak = {};
    weak.throughput_cutoff = 0.2f;
    for (const minirt_render_desc& desc : {region, deep, weak}) checkBoth(gpu, scene, desc);
}

TEST_CASE("where trees cannot be shared each lane follows its own, and without that kernel there is an error") {
    const TemporaryDir dir;
    GpuContext gpu;
    if (!gpu) return;
    test::allowSharedTrees(gpu.get());
    const auto both = bakeBoth(dir, nested());
    const Picture shared = LoadedScene(gpu, both).render(with(MINIRT_INTEGRATOR_WHITTED_SHARED));
    const Picture alone = LoadedScene(gpu, both).render(with(MINIRT_INTEGRATOR_WHITTED));
    CHECK_FALSE(shared == alone);  // by rounding
    CHECK(LoadedScene(gpu, both).render() == shared);
    std::string only = nested();
    only.replace(only.find("\"whitted\","), 10, "");
    const auto one = bakeBoth(dir, only);
    GpuContext other;
    test::denyBallots(other.get());
    const LoadedScene scene(other, one);
    minirt_render_desc desc = {};
    std::vector<float> pixels(size_t{20} * 12 * 4);
    CHECK(minirt_render(scene.get(), &desc, pixels.data()) == MINIRT_ERROR_DEVICE_UNSUPPORTED);
    CHECK(other.takeMessages() ==
          std::vector<std::string>{
              "'whitted_shared' takes a GPU with subgroup ballots; bake the scene with the integrator 'whitted' too"});
    if (gpu.isCpu()) CHECK(LoadedScene(other, bakeBoth(dir, nested())).render(with(MINIRT_INTEGRATOR_WHITTED_SHARED)) == alone);
}

TEST_CASE("a blob holds the kernel for shared trees where it was asked for") {
    const TemporaryDir dir;
    const auto kernels = [&](const std::string& json, bool shareTrees) {
        minirtc::BakeOptions options;
        options.shareTrees = shareTrees;
        options.onlyDefault = true;
        const std::filesystem::path file = test::bakeScene(dir, json, "some", options);
        std::ifstream stream(file, std::ios::binary);
        const std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
        minirt_blob blob;
        REQUIRE(minirt_validate(bytes.data(), bytes.size(), &blob, nullptr) == MINIRT_OK);
        std::set<std::string> names;
        for (uint64_t i = 0; i < blob.kernel_count; ++i) names.insert(blob.kernels[i].name);
        return names;
    };
    std::string one = balls();
    one.replace(one.find(R"("integrators":["whitted","whitted_shared"],)"), 43, "");
    CHECK(kernels(one, false) == std::set<std::string>{"whitted"});
    CHECK(kernels(one, true) == std::set<std::string>{"whitted", "whitted_shared"});
    std::string paths = balls();
    paths.replace(paths.find(R"(["whitted","whitted_shared"])"), 28, R"(["path"])");
    CHECK_THROWS_WITH_AS(kernels(paths, true), doctest::Contains("--share-trees"), minirtc::Error);
}

TEST_CASE("shared trees are recorded into an image of the host as they are rendered") {
    test::HostDevice host;
    if (!host) return;
    const TemporaryDir dir;
    minirt_context_desc desc = {};
    desc.host = host.desc();
    minirt_context* context = nullptr;
    REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
    test::allowSharedTrees(context);
    minirt_scene* scene = nullptr;
    REQUIRE(minirt_load_file(context, bakeBoth(dir, nested()).string().c_str(), &scene) == MINIRT_OK);
    minirt_render_desc render = with(MINIRT_INTEGRATOR_WHITTED_SHARED);
    render.first_sample = 3;
    render.samples = 1;
    std::vector<float> expected(size_t{20} * 12 * 4);
    REQUIRE(minirt_render(scene, &render, expected.data()) == MINIRT_OK);
    minirt_job* job = nullptr;
    REQUIRE(minirt_begin(scene, &render, &job) == MINIRT_OK);
    for (const uint32_t passes : {4u, 40u}) {
        CAPTURE(passes);
        const std::vector<float> image = host.recordToImage(20, 12, [&](VkCommandBuffer commands, VkImage target) {
            REQUIRE(minirt_record(job, commands, target, nullptr, 3, passes) == MINIRT_OK);
        });
        CHECK(std::equal(image.begin(), image.end(), expected.begin()));
    }
    minirt_end(job);
    minirt_destroy(context);
}
