// The wavefront is the megakernel in other kernels: the same random numbers, the same picture, the same rays.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <set>

#include "blob_file.hpp"
#include "closed_mesh.hpp"
#include "effects.hpp"
#include "host_device.hpp"
#include "image_text.hpp"
#include "runtime_hooks.hpp"
#include "scene_text.hpp"

using test::bakeScene;
using test::GpuContext;
using test::Kernels;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

constexpr uint32_t kWidth = 32;
constexpr uint32_t kHeight = 24;

struct NamedScene {
    std::string name;
    std::string json;
    minirtc::LayoutChoice layout = minirtc::LayoutChoice::quantised;
};

/// The start of a scene, up to its materials; `more`: further members.
std::string sceneStart(const std::string& camera, const std::string& render, const std::string& more) {
    return R"({"camera":{)" + camera + R"(},"render":{"integrator":"path","maxDepth":6,"size":[32,24])" + render + "}," + more;
}

/// Images and meshes that the scenes name.
void writeFiles(const TemporaryDir& dir) {
    using test::Rgba;
    const auto byte = [](double v) { return static_cast<unsigned char>(std::lround(255 * v)); };
    dir.write("wood.tga", test::tga(16, 16, [&](int x, int y) {
                  return Rgba{200, byte(0.3 + 0.03 * (x ^ y)), 70, byte((x + y) / 32.0)};
              }));
    dir.write("worn.tga", test::tga(8, 8, [&](int x, int y) { return Rgba{0, byte(0.2 + 0.1 * x), byte(y / 8.0), 255}; }));
    dir.write("bumps.tga", test::tga(8, 8, [&](int x, int y) {
                  return Rgba{byte(0.5 + 0.2 * std::sin(x)), byte(0.5 + 0.2 * std::cos(2 * y)), 230, 255};
              }));
    dir.write("sky.tga", test::tga(32, 16, [&](int x, int y) {
                  return x / 4 == 2 && y / 2 == 2 ? Rgba{255, 250, 220, 255}
                                                  : Rgba{byte(0.1 + 0.02 * y), 60, byte(0.5 - 0.02 * y), 255};
              }));
    std::string smooth;
    const test::ClosedMesh ball = test::ball(2);
    for (const glm::dvec3& p : ball.positions) {
        const std::string text = std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
        smooth += "v " + text + "vn " + text + "vt " + std::to_string(p.x) + " " + std::to_string(p.y) + "\n";
    }
    for (const auto& face : ball.faces) {
        smooth += "f";
        for (const uint32_t i : face)
            smooth += " " + std::to_string(i + 1) + "/" + std::to_string(i + 1) + "/" + std::to_string(i + 1);
        smooth += "\n";
    }
    dir.write("ball.obj", smooth);
    std::string chain;  // two pieces that lap into one another
    for (const double at : {0.0, 0.7}) {
        for (int i = 0; i < 8; ++i)
            chain += "v " + std::to_string(at + (i & 1)) + " " + std::to_string(0.3 * at + (i >> 1 & 1)) + " " +
                     std::to_string(0.4 * at + (i >> 2)) + "\n";
        for (const char* quad : {"-8 -6 -5 -7", "-4 -3 -1 -2", "-8 -7 -3 -4", "-6 -2 -1 -5", "-8 -4 -2 -6", "-7 -5 -1 -3"})
            chain += std::string("f ") + quad + "\n";
    }
    dir.write("chain.obj", chain);
}

/// Every kind of light without a background, over matte, coated, phong and checkered surfaces.
NamedScene lampsScene() {
    return {
        "lamps",
        sceneStart(R"("position":[0,2.2,4.5],"target":[0,0.7,0],"vfov":48)", "",
                   R"("lights":[{"type":"point","position":[2,3,1],"intensity":[6,5,4]},)"
                   R"({"type":"directional","direction":[1,-3,-1],"irradiance":[0.3,0.3,0.4]},)"
                   R"({"type":"spot","position":[-2,3,1],"direction":[1,-2,-1],"intensity":[9,9,9],"outerConeAngle":30},)"
                   R"({"type":"rectangle","origin":[-1,3,-1],"u":[2,0,0],"v":[0,0,1],"radiance":[4,4,3]},)"
                   R"({"type":"sphere","center":[1.6,0.5,1.2],"radius":0.2,"radiance":[6,3,1]}],)") +
            R"("materials":{"white":{"model":"pbr","ior":1,"baseColor":[0.7,0.7,0.7]},"gold":{"model":"pbr","metallic":1,"roughness":0.3,"baseColor":[1,0.8,0.3]},
        "coat":{"model":"pbr","baseColor":[0.2,0.5,0.3],"roughness":0.1},"shiny":{"model":"phong","diffuse":0.5,"specular":0.4,"reflect":0.2,"color":[0.9,0.4,0.4]},
        "tiles":{"model":"checker","a":"white","b":"shiny","scale":0.7},"glow":{"model":"pbr","emissive":[2,1,3],"doubleSided":true}},
        "objects":[)" +
            test::floorOf("tiles") + "," + test::sphere({-1.2, 0.6, 0}, 0.6, "gold") + "," +
            test::sphere({0.2, 0.5, 0.8}, 0.5, "coat") +
            R"(,{"mesh":"ball.obj","material":"shiny","scale":0.4,"translate":[1.3,0.4,-0.8]},{"mesh":"ball.obj","material":"glow","smooth":false,"scale":0.2,"translate":[0,1.8,-1]}]})"};
}

/// A panorama and an area light through a lens, over maps of all kinds and surfaces with holes; float nodes.
NamedScene mapsScene() {
    return {
        "maps",
        sceneStart(R"("position":[0,1.6,4],"target":[0,0.6,0],"vfov":45,"aperture":0.1,"focusDistance":4)",
                   R"(,"filter":"gaussian")", R"("background":{"image":"sky.tga","rotation":40,"strength":2},)") +
            R"("materials":{"worn":{"model":"pbr","metallic":1,"roughness":1,"baseColor":"wood.tga","metallicRoughnessTexture":"worn.tga","normalTexture":"bumps.tga"},
        "screen":{"model":"pbr","emissive":[3,3,3],"emissiveTexture":"wood.tga","doubleSided":true},"leaf":{"model":"pbr","baseColor":"wood.tga","alphaMode":"mask"},
        "veil":{"model":"pbr","ior":1,"baseColor":"wood.tga","alphaMode":"blend","alpha":0.7},"ground":{"model":"pbr","baseColor":[0.5,0.5,0.5],"normalTexture":"bumps.tga"}},
        "objects":[)" +
            test::floorOf("ground") + "," +
            R"({"mesh":"ball.obj","material":"worn","scale":0.7,"translate":[-0.9,0.7,0]},)"
            R"({"mesh":"ball.obj","material":"leaf","scale":0.6,"translate":[0.9,0.6,0.3]},)"
            R"({"mesh":"ball.obj","material":"veil","scale":[0.9,0.9,0.05],"translate":[0.2,0.9,1.2]},)"
            R"({"mesh":"ball.obj","material":"screen","scale":[0.5,0.3,0.1],"translate":[0.2,1.3,-1]}]})",
        minirtc::LayoutChoice::floating};
}

/// The camera in water in a dish, among frosted and thin glass, a lamp, ice that laps in and a fish.
NamedScene nestedScene(const std::string& name, const std::string& members, const std::string& render, const std::string& chain) {
    const std::string clear = R"({"model":"pbr","transmission":1,)";
    return {
        name,
        sceneStart(R"("position":[0.3,0.2,0.9],"target":[0,0,-1],"vfov":70)", render, members) +
            R"("lights":[{"type":"point","position":[-0.5,0.6,0],"intensity":[3,3,3]},)"
            R"({"type":"directional","direction":[1,-2,-1],"irradiance":[1,1,1]}],"materials":{"water":)" +
            clear + R"("roughness":0,"ior":1.33,"attenuationColor":[0.3,0.8,0.9],"inscatter":0.3},"ice":)" + clear +
            R"("roughness":0,"glass":"ice"},"frosted":)" + clear +
            R"("roughness":0.3,"ior":1.5,"attenuationColor":[0.9,0.5,0.4]},"pane":)" + clear +
            R"("roughness":0,"thin":true},"lamp":{"model":"pbr","baseColor":[0,0,0],"emissive":[5,4,3]},
        "fish":{"model":"phong","diffuse":0.6,"reflect":0.3}},"objects":[)"
            R"({"sphere":{"center":[0,0,0],"radius":2},"material":"water"},{"sphere":{"center":[0,0,-1.8],"radius":0.7},"material":"ice"},)"
            R"({"sphere":{"center":[0.4,0,1.2],"radius":0.8},"material":"ice"},{"sphere":{"center":[0.8,-0.4,-0.7],"radius":0.35},"material":"frosted"},)"
            R"({"sphere":{"center":[-0.5,-0.3,-0.6],"radius":0.3},"material":"fish"},{"sphere":{"center":[0.3,0.8,-1],"radius":0.15},"material":"lamp"},)"
            R"({"rectangle":{"origin":[-1,-1,-0.2],"u":[2,0,0],"v":[0,0.6,-0.5]},"material":"pane"},)" +
            chain + R"({"rectangle":{"origin":[-9,-2.5,9],"u":[18,0,0],"v":[0,0,-18]},"material":"fish"}]})"};
}

const char* const kChain = R"({"mesh":"chain.obj","material":"frosted","scale":0.4,"translate":[-1.2,0.1,-1.4]},)";
const char* const kWall =
    R"("materials":{"wall":{"model":"pbr"}},"objects":[{"sphere":{"center":[0,0,-3],"radius":1},"material":"wall"}]})";

std::vector<NamedScene> scenes() {
    const std::string sky = R"("background":{"color":[0.5,0.7,1]},)";
    return {lampsScene(),
            mapsScene(),
            nestedScene("three channels", sky, "", ""),
            nestedScene("wavelengths", sky, R"(,"dispersionMode":"spectral","filter":"tent")", ""),
            nestedScene("parity, volumes that overlap themselves", R"("nesting":"parity",)", "", kChain),
            {"a sky alone", sceneStart(R"("vfov":40)", "", R"("background":{"color":[1,0.9,0.8]},)") + kWall},
            {"no light at all", sceneStart(R"("vfov":40)", "", "") + kWall}};
}

/// What is rendered of every scene.
std::vector<minirt_render_desc> requests() {
    minirt_render_desc plain = {};
    plain.samples = 2;
    std::vector<minirt_render_desc> all(7, plain);
    all[1].max_depth = 1;
    all[1].samples = 1;
    all[2].max_depth = 256;
    all[2].samples = 1;
    all[3].region = {3, 5, 17, 11};
    all[3].first_sample = 5;
    all[3].seed = 7;
    all[4].region = {31, 0, 1, 24};
    all[4].light_sampling = MINIRT_LIGHT_SAMPLING_MIS_BALANCE;
    all[5].clamp = 0.25f;
    all[5].light_sampling = MINIRT_LIGHT_SAMPLING_LIGHTS;
    all[6].max_dispatch_ms = 1e-6f;
    all[6].light_sampling = MINIRT_LIGHT_SAMPLING_SURFACES;
    return all;
}

std::vector<Picture> renderAll(const LoadedScene& scene, minirt_integrator integrator) {
    std::vector<Picture> pictures;
    for (minirt_render_desc desc : requests()) {
        desc.integrator = integrator;
        pictures.push_back(scene.render(desc));
    }
    return pictures;
}

/// The largest distance of two floats of the pictures, in units in the last place.
uint64_t distance(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    const auto ordered = [](float f) {
        int32_t bits;
        std::memcpy(&bits, &f, sizeof bits);
        return bits < 0 ? -int64_t{bits & 0x7fffffff} : int64_t{bits};
    };
    int64_t most = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i) most = std::max(most, std::abs(ordered(a.rgba[i]) - ordered(b.rgba[i])));
    return static_cast<uint64_t>(most);
}

/// How far the two kinds of kernels may be apart: nothing on a processor, where both are compiled alike.
uint64_t allowedDistance(const GpuContext& gpu) {
    return gpu.isCpu() ? 0 : 4;
}

void checkSame(const GpuContext& gpu, const Picture& path, const Picture& wavefront) {
    CHECK(distance(path, wavefront) <= allowedDistance(gpu));
    CHECK(path.stats.primary_rays == wavefront.stats.primary_rays);
    CHECK(path.stats.secondary_rays == wavefront.stats.secondary_rays);
    CHECK(path.stats.shadow_rays == wavefront.stats.shadow_rays);
    CHECK(path.stats.volume_overflow == wavefront.stats.volume_overflow);
}

double mean(const Picture& picture) {
    double sum = 0;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) sum += picture.rgba[i] + picture.rgba[i + 1] + picture.rgba[i + 2];
    return sum / (0.75 * static_cast<double>(picture.rgba.size()));
}

minirtc::EffectSet effectsOf(const TemporaryDir& dir, const NamedScene& named) {
    minirtc::Diagnostics diagnostics;
    const minirtc::Scene scene = minirtc::loadScene(dir.write("scene.json", named.json), diagnostics);
    const minirtc::Geometry geometry = minirtc::flatten(scene, diagnostics);
    return minirtc::analyseEffects(scene, geometry, minirtc::analyseVolumes(scene, geometry, diagnostics),
                                   named.layout == minirtc::LayoutChoice::floating, true);
}

}  // namespace

TEST_CASE("the scenes of these tests call for every effect") {
    TemporaryDir dir;
    writeFiles(dir);
    std::set<std::string> missing;
    std::vector<minirtc::EffectSet> sets;
    for (const NamedScene& scene : scenes()) sets.push_back(effectsOf(dir, scene));
    for (size_t i = 0; i < minirtc::kEffectCount; ++i) {
        const auto effect = static_cast<minirtc::Effect>(i);
        CAPTURE(minirtc::effectInfo(effect).name);
        CHECK(std::any_of(sets.begin(), sets.end(), [&](const minirtc::EffectSet& set) { return set.has(effect); }));
    }
}

TEST_CASE("megakernel and wavefront give the same picture and the same rays") {
    TemporaryDir dir;
    writeFiles(dir);
    GpuContext gpu;
    if (!gpu) return;
    for (const NamedScene& named : scenes()) {
        CAPTURE(named.name);
        const LoadedScene scene(gpu, bakeScene(dir, named.json, named.layout, Kernels::ofAll));
        const std::vector<Picture> path = renderAll(scene, MINIRT_INTEGRATOR_PATH);
        const std::vector<Picture> wavefront = renderAll(scene, MINIRT_INTEGRATOR_WAVEFRONT);
        for (size_t i = 0; i < path.size(); ++i) {
            CAPTURE(i);
            checkSame(gpu, path[i], wavefront[i]);
            if (path[i].stats.secondary_rays > 0) CHECK((mean(path[i]) > 0) == (named.name != "no light at all"));
        }
    }
}

TEST_CASE("paths that spend their budget of steps go on where they were") {
    TemporaryDir dir;
    writeFiles(dir);
    int resumed = 0;
    for (const NamedScene& named : scenes()) {
        CAPTURE(named.name);
        const auto blob = bakeScene(dir, named.json, named.layout, Kernels::ofAll);
        GpuContext gpu;
        if (!gpu) return;
        GpuContext hasty;
        test::setStepBudget(hasty.get(), gpu.isCpu() ? 5 : 2);  // less than any ray takes, and more than one that is done
        const LoadedScene whole(gpu, blob);
        const LoadedScene parts(hasty, blob);
        for (const minirt_integrator integrator : {MINIRT_INTEGRATOR_PATH, MINIRT_INTEGRATOR_WAVEFRONT}) {
            minirt_render_desc desc = {};
            desc.integrator = integrator;
            const Picture expected = whole.render(desc);
            const Picture picture = parts.render(desc);
            checkSame(gpu, expected, picture);
            resumed += picture.stats.resumed_dispatches > expected.stats.resumed_dispatches;
        }
    }
    CHECK(resumed >= 10);  // both kinds of five scenes; a round of the wavefront goes on with rays too
}

TEST_CASE("both are the same where they are specialised as for a GPU") {
    TemporaryDir dir;
    writeFiles(dir);
    for (const NamedScene& named : {mapsScene(), scenes()[2]}) {
        CAPTURE(named.name);
        const auto blob = bakeScene(dir, named.json, named.layout, Kernels::ofAll);
        GpuContext gpu;
        if (!gpu) return;
        GpuContext other;
        test::specialiseAsGpu(other.get());
        for (const minirt_integrator integrator : {MINIRT_INTEGRATOR_PATH, MINIRT_INTEGRATOR_WAVEFRONT}) {
            minirt_render_desc desc = {};
            desc.integrator = integrator;
            checkSame(gpu, LoadedScene(gpu, blob).render(desc), LoadedScene(other, blob).render(desc));
        }
    }
}

TEST_CASE("without ballots in subgroups one kernel draws the scene, and who asks for the wavefront is told") {
    GpuContext gpu;
    if (!gpu) return;
    test::denyBallots(gpu.get());
    TemporaryDir dir;
    writeFiles(dir);
    const LoadedScene scene(gpu, bakeScene(dir, lampsScene().json, minirtc::LayoutChoice::automatic, Kernels::ofAll));
    minirt_render_desc desc = {};
    scene.render(desc);  // by default
    desc.integrator = MINIRT_INTEGRATOR_WAVEFRONT;
    minirt_job* job = nullptr;
    CHECK(minirt_begin(scene.get(), &desc, &job) == MINIRT_ERROR_DEVICE_UNSUPPORTED);
    CHECK(gpu.takeMessages() ==
          std::vector<std::string>{"the wavefront needs subgroup ballots, which this device lacks; use the integrator 'path'"});
}

TEST_CASE("a blob holds no kernel of the wavefront whose queue stays empty") {
    const std::set<std::string> always = {"path", "wave_accumulate", "wave_closest", "wave_generate", "wave_hit"};
    const auto with = [&](std::set<std::string> more) {
        more.insert(always.begin(), always.end());
        return more;
    };
    TemporaryDir dir;
    writeFiles(dir);
    const auto kernels = [&](const std::string& json) {
        std::set<std::string> names =
            test::kernelNames(test::Blob::read(bakeScene(dir, json, minirtc::LayoutChoice::automatic, Kernels::ofAll)));
        names.erase("whitted");
        return names;
    };
    const std::vector<NamedScene> all = scenes();
    CHECK(kernels(all[6].json) == always);                                                   // no light at all
    CHECK(kernels(all[5].json) == with({"wave_miss", "wave_shadow"}));                       // a sky alone
    CHECK(kernels(lampsScene().json) == with({"wave_shadow"}));                              // black behind the lamps
    CHECK(kernels(nestedScene("", "", "", "").json) == with({"wave_miss", "wave_shadow"}));  // black, but rays track volumes
}

TEST_CASE("samples in two parts are the samples of the whole") {
    TemporaryDir dir;
    writeFiles(dir);
    GpuContext gpu;
    if (!gpu) return;
    const LoadedScene scene(gpu, bakeScene(dir, lampsScene().json, minirtc::LayoutChoice::automatic, Kernels::ofAll));
    for (const minirt_integrator integrator : {MINIRT_INTEGRATOR_PATH, MINIRT_INTEGRATOR_WAVEFRONT}) {
        const auto samples = [&](uint32_t first, uint32_t end) {
            minirt_render_desc desc = {};
            desc.integrator = integrator;
            desc.first_sample = first;
            desc.samples = end - first;
            return scene.render(desc);
        };
        const Picture one = samples(3, 4), other = samples(4, 5), both = samples(3, 5);
        const Picture start = samples(2, 5), end = samples(5, 11), whole = samples(2, 11);
        double worst = 0;
        for (size_t i = 0; i < both.rgba.size(); ++i) {
            REQUIRE(both.rgba[i] == (one.rgba[i] + other.rgba[i]) / 2);
            const double expected = (3.0 * start.rgba[i] + 6.0 * end.rgba[i]) / 9;
            worst = std::max(worst, std::abs(whole.rgba[i] - expected) / std::max(expected, 1e-3));
        }
        CHECK(worst < 1e-6);  // nine floats, added in another order
        CHECK(one.rgba != other.rgba);
    }
}

TEST_CASE("another seed gives another picture with the same mean") {
    TemporaryDir dir;
    writeFiles(dir);
    GpuContext gpu;
    if (!gpu) return;
    for (const NamedScene& named : {lampsScene(), scenes()[3]}) {
        CAPTURE(named.name);
        const LoadedScene scene(gpu, bakeScene(dir, named.json));
        constexpr int kSeeds = 24;
        std::vector<Picture> pictures;
        double sum = 0, squares = 0;
        for (uint32_t seed = 0; seed < kSeeds; ++seed) {
            minirt_render_desc desc = {};
            desc.seed = seed * 0x01000193u;
            desc.samples = 2;
            pictures.push_back(scene.render(desc));
            for (uint32_t other = 0; other < seed; ++other) CHECK(pictures[seed].rgba != pictures[other].rgba);
            sum += mean(pictures[seed]);
            squares += mean(pictures[seed]) * mean(pictures[seed]);
        }
        minirt_render_desc desc = {};
        desc.samples = 2 * kSeeds;
        const double one = mean(scene.render(desc));
        const double average = sum / kSeeds;
        const double sigma = std::sqrt((squares / kSeeds - average * average) / (kSeeds - 1));
        MESSAGE("mean of ", kSeeds, " seeds ", average, " +- ", sigma, "; of as many samples of one seed ", one);
        CHECK(std::abs(one - average) < 5 * sigma);
        CHECK(sigma < 0.03 * average);
    }
}

TEST_CASE("another seed has other wavelengths") {
    // A sample in a white room that ends up with one of four wavelengths has its colour.
    TemporaryDir dir;
    GpuContext gpu;
    if (!gpu) return;
    const LoadedScene scene(
        gpu, bakeScene(dir, sceneStart(R"("position":[0,0,4],"target":[0,0,0],"vfov":10)", R"(,"dispersionMode":"spectral")",
                                       R"("background":{"color":[1,1,1]},)") +
                                R"("materials":{"flint":{"model":"pbr","transmission":1,"roughness":0,"glass":"SF11"}},
        "objects":[{"sphere":{"center":[0,0,0],"radius":1.5},"material":"flint"}]})"));
    constexpr uint32_t kSeeds = 64;
    std::set<float> hues;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        minirt_render_desc desc = {};
        desc.seed = seed;
        desc.region = {16, 12, 1, 1};
        const glm::vec3 color = scene.render(desc).at(16, 12);
        hues.insert(std::round(1000 * color.x / color.y));
    }
    CHECK(hues.size() > kSeeds / 2);
}

TEST_CASE("both record into an image of the host what they render") {
    test::HostDevice host;
    if (!host) return;
    TemporaryDir dir;
    writeFiles(dir);
    minirt_context_desc desc = {};
    desc.host = host.desc();
    minirt_context* context = nullptr;
    REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
    minirt_scene* scene = nullptr;
    const auto blob = bakeScene(dir, nestedScene("", "", "", "").json, minirtc::LayoutChoice::automatic, Kernels::ofAll);
    REQUIRE(minirt_load_file(context, blob.string().c_str(), &scene) == MINIRT_OK);
    for (const minirt_integrator integrator : {MINIRT_INTEGRATOR_PATH, MINIRT_INTEGRATOR_WAVEFRONT}) {
        minirt_render_desc render = {};
        render.integrator = integrator;
        render.first_sample = 3;
        render.samples = 1;
        std::vector<float> expected(kWidth * kHeight * 4);
        REQUIRE(minirt_render(scene, &render, expected.data()) == MINIRT_OK);
        minirt_job* job = nullptr;
        REQUIRE(minirt_begin(scene, &render, &job) == MINIRT_OK);
        for (const uint32_t passes : {1u, 100u}) {
            CAPTURE(passes);
            const std::vector<float> image = host.recordToImage(kWidth, kHeight, [&](VkCommandBuffer commands, VkImage target) {
                REQUIRE(minirt_record(job, commands, target, nullptr, 3, passes) == MINIRT_OK);
            });
            minirt_stats stats;
            REQUIRE(minirt_get_stats(job, &stats) == MINIRT_OK);
            uint64_t missing = 0;
            for (size_t i = 0; i < image.size(); i += 4) {
                missing += image[i + 3] == 0.0f;
                if (image[i + 3] != 0.0f) REQUIRE(std::memcmp(&image[i], &expected[i], 16) == 0);
            }
            CHECK(stats.traversal_cap == missing);
            CHECK((passes == 1 || missing == 0));
        }
        minirt_end(job);
    }
    minirt_destroy(context);
}
