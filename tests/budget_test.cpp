// Some CPU drivers end all loops of an invocation after 65,535 passes without a word. These scenes need several times as many for each
// pixel and have values known in closed form: they fail where pictures are cut short.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>

#include "render_scene.hpp"
#include "runtime_hooks.hpp"

using glm::dvec3;
using test::GpuContext;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

constexpr uint64_t kManySteps = 200000;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

/// `count` needles along the diagonal of the unit cube, in a bundle one millimetre thick: the box of each is nearly the whole cube.
std::string needles(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        const double x = 1e-3 * std::fmod(i * 0.7548776662466927, 1.0), y = 1e-3 * std::fmod(i * 0.5698402909980532, 1.0);
        const std::string a = number(x) + " " + number(y) + " 0", b = number(1 + x) + " " + number(1 + y) + " 1";
        text += "v " + a + "\nv " + b + "\nv " + number(1 + x + 1e-5) + " " + number(1 + y) + " 1\n";
        text += "f -3 -2 -1\n";
    }
    return text;
}

/// Looks through the cube of needles beside all of them, at a wall that shines with 2.5. The left half of the picture ends at a
/// wall before the cube, of 1.5, so that neighbours differ in length.
std::string needleScene() {
    return R"({"camera":{"position":[0.8,0.25,3],"target":[0.8,0.25,0],"vfov":4},"render":{"size":[8,8]},
        "materials":{"needle":{"model":"pbr","emissive":[100,100,100]},"far":{"model":"pbr","emissive":[2.5,2.5,2.5]},
                     "near":{"model":"pbr","emissive":[1.5,1.5,1.5]}},
        "objects":[{"mesh":"needles.obj","material":"needle"},
                   {"rectangle":{"origin":[-5,-5,-2],"u":[10,0,0],"v":[0,10,0]},"material":"far"},
                   {"rectangle":{"origin":[-4.2,-5,-1],"u":[5,0,0],"v":[0,10,0]},"material":"near"}]})";
}

constexpr int kNeedles = 160000;

bool isNeedlePicture(const Picture& picture) {
    for (uint32_t i = 0; i < 64; ++i)
        if (picture.at(i % 8, i / 8) != glm::vec3(i % 8 < 4 ? 1.5f : 2.5f)) return false;
    return true;
}

constexpr int kLights = 240;
constexpr uint32_t kBounces = 200;

double lightHeight(int i) {
    return 0.1 + 0.8 * i / kLights;  // in thousandths it is no binary fraction; the light is where float puts it
}

/// Two mirrors that face each other, 1 m apart, lit by lights on the axis between them; the camera looks along it.
std::string mirrorScene() {
    std::string lights;
    for (int i = 0; i < kLights; ++i)
        lights += std::string(i ? "," : "") + R"({"type":"point","position":[0,0,)" + number(lightHeight(i)) +
                  R"(],"intensity":[1,1,1],"falloff":"none"})";
    return R"({"camera":{"position":[0,0,0.5],"target":[0,0,0],"vfov":0.5},"render":{"size":[8,8],"maxDepth":)" +
           std::to_string(kBounces) + R"(},"lights":[)" + lights +
           R"(],"materials":{"m":{"model":"phong","diffuse":0.0078125,"reflect":0.984375}},
        "objects":[{"rectangle":{"origin":[-4,-4,0],"u":[8,0,0],"v":[0,8,0]},"material":"m"},
                   {"rectangle":{"origin":[-4,-4,1],"u":[0,8,0],"v":[8,0,0]},"material":"m"}]})";
}

/// The sum over all bounces of what the lights add there, the path unfolded.
double mirrorValue(uint32_t x, uint32_t y) {
    const double half = std::tan(0.25 * 3.14159265358979323846 / 180);
    const double u = ((x + 0.5) / 4 - 1) * half, v = ((y + 0.5) / 4 - 1) * half;
    const double slope = std::sqrt(u * u + v * v);
    double sum = 0, throughput = 1;
    for (uint32_t k = 0; k <= kBounces; ++k, throughput *= 0.984375) {
        const double aside = slope * (0.5 + k);
        for (int i = 0; i < kLights; ++i) {
            const double height = k % 2 == 0 ? lightHeight(i) : 1 - lightHeight(i);
            sum += throughput * 0.0078125 * height / std::sqrt(height * height + aside * aside);
        }
    }
    return sum;
}

double mirrorError(const Picture& picture) {
    double worst = 0;
    for (uint32_t i = 0; i < 64; ++i) {
        const double expected = mirrorValue(i % 8, i / 8);
        worst = std::max(worst, std::abs(picture.at(i % 8, i / 8).x / expected - 1));
    }
    return worst;
}

/// Mirrors, glass and many objects: rays of all kinds, waiting ones too.
std::string smallScene() {
    std::string balls;
    for (int i = 0; i < 60; ++i) {
        const double angle = i * 2.399963, radius = 0.35 * std::sqrt(i + 0.5);
        balls += R"(,{"sphere":{"center":[)" + number(radius * std::cos(angle)) + ",0.2," + number(radius * std::sin(angle)) +
                 R"(],"radius":0.2},"material":")" +
                 (i % 3 == 0   ? "glass"
                  : i % 3 == 1 ? "mirror"
                               : "matt") +
                 "\"}";
    }
    return R"({"camera":{"position":[0,2,5],"target":[0,0,0],"vfov":45},"render":{"size":[40,40],"maxDepth":8},"background":{"color":[0.2,0.3,0.5]},
        "lights":[{"type":"point","position":[3,4,2],"intensity":[20,20,20]},{"type":"directional","direction":[1,-2,-1]}],
        "materials":{"glass":{"model":"pbr","roughness":0,"transmission":1},"mirror":{"model":"phong","diffuse":0.1,"reflect":0.8},
                     "matt":{"model":"phong","color":[0.7,0.3,0.2]}},
        "objects":[{"rectangle":{"origin":[-6,0,-6],"u":[0,0,12],"v":[12,0,0]},"material":"matt"})" +
           balls + "]}";
}

/// A wavy floor of 1682 triangles, under a ball of glass and one that mirrors.
std::string facets(const TemporaryDir& dir) {
    constexpr int kSide = 30;
    std::string obj;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j)
            obj += "v " + number(0.2 * i - 3) + " " + number(0.02 * (i * 7 % 5 + j * 3 % 4)) + " " + number(0.2 * j - 3) + "\n";
    for (int i = 1; i < kSide; ++i)
        for (int j = 1; j < kSide; ++j) {
            const int last = kSide * i + j + 1;
            for (const int corner : {last - kSide - 1, last - kSide, last, last - 1})
                obj += (corner == last - kSide - 1 ? "f " : " ") + std::to_string(corner);
            obj += "\n";
        }
    dir.write("facets.obj", obj);
    return R"({"camera":{"position":[0,2,5],"target":[0,0,0],"vfov":45},"render":{"size":[24,24],"maxDepth":4},"background":{"color":[0.2,0.3,0.5]},
        "lights":[{"type":"point","position":[3,4,2],"intensity":[20,20,20]}],
        "materials":{"glass":{"model":"pbr","roughness":0,"transmission":1},"mirror":{"model":"phong","diffuse":0.1,"reflect":0.8},
                     "matt":{"model":"phong","color":[0.7,0.3,0.2]}},
        "objects":[{"mesh":"facets.obj","material":"matt"},{"sphere":{"center":[-0.6,0.6,0],"radius":0.5},"material":"glass"},
                   {"sphere":{"center":[0.7,0.6,0.2],"radius":0.5},"material":"mirror"}]})";
}

}  // namespace

TEST_CASE("a traversal past a hundred thousand needles is not cut short") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    dir.write("needles.obj", needles(kNeedles));
    const LoadedScene scene(gpu, test::bakeScene(dir, needleScene()));
    const Picture picture = scene.render();
    CHECK(isNeedlePicture(picture));
    // One block: every resumed dispatch spent the budget of some pixel.
    if (gpu.isCpu()) CHECK(picture.stats.resumed_dispatches * test::stepBudget(gpu.get()) > kManySteps);
    CHECK(picture.stats.traversal_cap == 0);
    MESSAGE("steps: " << picture.stats.resumed_dispatches * test::stepBudget(gpu.get()));
}

TEST_CASE("a path of many bounces between many lights is not cut short") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, test::bakeScene(dir, mirrorScene()));
    const Picture picture = scene.render();
    const double error = mirrorError(picture);
    MESSAGE("largest error " << error << "; steps: " << picture.stats.resumed_dispatches * test::stepBudget(gpu.get()));
    CHECK(error < 3e-5);  // of a sum of fifty thousand floats
    CHECK(picture.stats.resumed_dispatches * test::stepBudget(gpu.get()) > kManySteps);
    CHECK(picture.stats.traversal_cap == 0);
    CHECK(picture.stats.secondary_rays == 64 * kBounces);
    CHECK(picture.stats.shadow_rays == 64ull * kLights * (kBounces + 1));
}

namespace {

constexpr int kColumns = 8;
constexpr int kLightsAColumn = 1000;

double columnX(int column) {
    return 2.4 * (column - 3.5);
}

/// Eight points of a floor in one vector of lanes and thousands of lights in eight bunches. Before each lane and its own bunch hangs a
/// stack of thin plates, which its shadow rays must all look at and pass: while one lane traverses, the other seven wait.
std::string divergentScene(const TemporaryDir& dir) {
    std::string plates;
    for (int column = 0; column < kColumns; ++column) {
        const double x = -0.15 + 0.1 * (column % 4), z = -0.045 + 0.09 * (column / 4);
        const dvec3 stack(x + (columnX(column) - x) * 0.1, 1, 0.9 * z);
        for (int k = 0; k < 150; ++k) {
            const double shift = 4e-4 * std::fmod(k * 0.618034, 1.0);
            for (const dvec3& corner : {dvec3(-0.015, -0.01, -0.01), dvec3(0.015, 0.01, 0.03), dvec3(-0.0145, -0.01, -0.01)}) {
                const dvec3 p = stack + corner + dvec3(shift, 0.5 * shift, shift);
                plates += "v " + number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
            }
            plates += "f -3 -2 -1\n";
        }
    }
    dir.write("plates.obj", plates);
    std::string lights;
    for (int i = 0; i < kColumns * kLightsAColumn; ++i)
        lights += std::string(i ? "," : "") + R"({"type":"point","position":[)" +
                  number(columnX(i % kColumns) + 2e-3 * std::fmod(i * 0.754878, 1.0)) + "," +
                  number(10 + 2e-3 * std::fmod(i * 0.56984, 1.0)) + R"(,0],"intensity":[0.001,0.001,0.001],"falloff":"none"})";
    return R"({"camera":{"position":[0,20,0],"target":[0,0,0],"up":[0,0,-1],"vfov":0.573},"render":{"size":[4,2]},"lights":[)" +
           lights + R"(],"materials":{"m":{"model":"phong"}},
        "objects":[{"rectangle":{"origin":[-9,0,9],"u":[18,0,0],"v":[0,0,-18]},"material":"m"},
                   {"mesh":"plates.obj","material":"m"}]})";
}

}  // namespace

TEST_CASE("lanes that wait for each other are not cut short") {
    TemporaryDir dir;
    std::filesystem::path blob;
    Picture pictures[2];
    bool countsPasses = true;
    for (const uint32_t steps : {500u, 0u}) {
        GpuContext gpu;
        if (!gpu) return;
        countsPasses = gpu.isCpu();
        if (steps) test::setStepBudget(gpu.get(), steps);
        if (blob.empty()) blob = test::bakeScene(dir, divergentScene(dir));
        pictures[steps ? 0 : 1] = LoadedScene(gpu, blob).render();
    }
    if (countsPasses) CHECK(pictures[1].stats.resumed_dispatches > 0);
    CHECK(pictures[1].stats.shadow_rays == 8ull * kColumns * kLightsAColumn);
    CHECK(pictures[0] == pictures[1]);
}

namespace {

/// Whether `works` in a process of its own, for it may crash or hang; a minute is too long.
bool worksApart(const std::function<bool()>& works) {
    const pid_t child = fork();
    if (child == 0) {
        for (const int crash : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) signal(crash, SIG_DFL);
        signal(SIGALRM, SIG_DFL);
        alarm(60);
        bool worked = false;
        try {
            worked = works();
        } catch (const std::exception&) {
        }
        _exit(worked ? 0 : 1);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Picture renderWithoutBudget(const TemporaryDir& dir, const std::string& json) {
    GpuContext gpu(0);
    test::setStepBudget(gpu.get(), 1u << 20);
    return LoadedScene(gpu, test::bakeScene(dir, json)).render();
}

}  // namespace

// The needles; mirrors come out right, where the loop over rays ends between two of them and what is left counts as pending.
TEST_CASE("without the budget this driver cuts a traversal short") {
    {
        GpuContext gpu;
        if (!gpu) return;
    }
    TemporaryDir dir;
    dir.write("needles.obj", needles(kNeedles));
    const bool needlesRight = worksApart([&] { return isNeedlePicture(renderWithoutBudget(dir, needleScene())); });
    if (needlesRight) return test::skip("this driver lets loops run on");
    CHECK(!needlesRight);
}

TEST_CASE("any budget of steps gives the same picture bit for bit") {
    TemporaryDir dir;
    Picture whole;
    for (const uint32_t steps : {0u, 2u, 3u, 7u, 64u, 500u}) {
        CAPTURE(steps);
        GpuContext gpu;
        if (!gpu) return;
        if (steps) test::setStepBudget(gpu.get(), steps);
        const Picture picture = LoadedScene(gpu, test::bakeScene(dir, smallScene())).render();
        if (steps == 0) {
            whole = picture;
            CHECK(whole.stats.resumed_dispatches == 0);
            continue;
        }
        CHECK(picture == whole);
        CHECK(picture.stats.resumed_dispatches > 0);
        CHECK(picture.stats.shadow_rays == whole.stats.shadow_rays);
        CHECK(picture.stats.secondary_rays == whole.stats.secondary_rays);
    }
}

/// The camera, a lamp, a fish and a pane lie in overlapping volumes: lists in rays that wait, in shadow rays and on the way to the camera.
std::string nestedScene(const std::string& nesting, const std::string& more) {
    const std::string clear = R"({"model":"pbr","roughness":0,"transmission":1,)";
    return R"({"camera":{"position":[0.3,0.2,0.9],"target":[0,0,-1],"vfov":70},"background":{"color":[0.5,0.7,1]},"nesting":")" +
           nesting +
           R"(","lights":[{"type":"point","position":[-0.5,0.6,0],"intensity":[3,3,3]},)"
           R"({"type":"directional","direction":[1,-2,-1],"irradiance":[1,1,1]}],"materials":{"water":)" +
           clear + R"("ior":1.33,"attenuationColor":[0.3,0.8,0.9],"inscatter":0.3},"ice":)" + clear +
           R"("glass":"ice"},"pane":)" + clear +
           R"("thin":true},"fish":{"model":"phong","diffuse":0.6,"reflect":0.3}},"objects":[)"
           R"({"sphere":{"center":[0,0,0],"radius":2},"material":"water"},{"sphere":{"center":[0,0,-1.8],"radius":0.7},"material":"ice"},)"
           R"({"sphere":{"center":[0.4,0,1.2],"radius":0.8},"material":"ice"},)"
           R"({"sphere":{"center":[-0.5,-0.3,-0.6],"radius":0.3},"material":"fish"},)"
           R"({"rectangle":{"origin":[-1,-1,-0.2],"u":[2,0,0],"v":[0,0.6,-0.5]},"material":"pane"},)"
           R"({"rectangle":{"origin":[-9,-2.5,9],"u":[18,0,0],"v":[0,0,-18]},"material":"fish"}],)"
           R"("render":{"size":[16,16],"maxDepth":4)" +
           more + "}}";
}

TEST_CASE("any budget of steps gives the same picture of nested volumes bit for bit") {
    TemporaryDir dir;
    for (const std::string nesting : {"ordered", "parity"})
        for (const std::string more : {"", R"(,"dispersionMode":"spectral")"}) {
            CAPTURE(nesting);
            CAPTURE(more);
            const auto blob = test::bakeScene(dir, nestedScene(nesting, more));
            GpuContext gpu;
            if (!gpu) return;
            const Picture whole = LoadedScene(gpu, blob).render();
            for (const uint32_t steps : {7u, 64u}) {
                CAPTURE(steps);
                GpuContext hasty;
                test::setStepBudget(hasty.get(), steps);
                const Picture picture = LoadedScene(hasty, blob).render();
                CHECK(picture == whole);
                CHECK(picture.stats.resumed_dispatches > 0);
                CHECK(picture.stats.shadow_rays == whole.stats.shadow_rays);
                CHECK(picture.stats.secondary_rays == whole.stats.secondary_rays);
            }
            GpuContext other;
            test::specialiseAsGpu(other.get());
            CHECK(LoadedScene(other, blob).render() == whole);
        }
}

TEST_CASE("any budget of steps gives the same picture of rays that play roulette bit for bit") {
    TemporaryDir dir;
    const auto blob =
        test::bakeScene(dir, nestedScene("ordered", R"(,"dispersionMode":"spectral","accuracy":{"weak_rays":"roulette"})"));
    minirt_render_desc desc = {};
    desc.throughput_cutoff = 0.2f;
    GpuContext gpu;
    if (!gpu) return;
    const Picture whole = LoadedScene(gpu, blob).render(desc);
    for (const uint32_t steps : {7u, 64u}) {
        CAPTURE(steps);
        GpuContext hasty;
        test::setStepBudget(hasty.get(), steps);
        const Picture picture = LoadedScene(hasty, blob).render(desc);
        CHECK(picture == whole);
        CHECK(picture.stats.resumed_dispatches > 0);
        CHECK(picture.stats.secondary_rays == whole.stats.secondary_rays);
    }
}

TEST_CASE("kernels specialised as for a GPU give the same picture bit for bit") {
    TemporaryDir dir;
    Picture pictures[2];
    for (const bool asGpu : {false, true}) {
        GpuContext gpu;
        if (!gpu) return;
        if (asGpu) test::specialiseAsGpu(gpu.get());
        test::setStepBudget(gpu.get(), 500);
        const LoadedScene scene(gpu, test::bakeScene(dir, smallScene()));
        pictures[asGpu] = scene.render();
    }
    CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("a GPU whose storage buffers are too small for a scene reads it as texels, for the same picture bit for bit") {
    TemporaryDir dir;
    const std::filesystem::path blob = test::bakeScene(dir, facets(dir));
    Picture pictures[2];
    for (const bool tooSmall : {false, true}) {
        GpuContext gpu;
        if (!gpu) return;
        test::specialiseAsGpu(gpu.get());
        if (tooSmall) test::limitStorage(gpu.get(), 64u << 10);
        const LoadedScene scene(gpu, blob);
        CHECK(test::fetchesTexels(scene.get()) == tooSmall);
        pictures[tooSmall] = scene.render();
    }
    CHECK(pictures[0] == pictures[1]);
}
