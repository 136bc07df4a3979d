// The seed's whisky against its exact split interfaces. Its meshes overlap; which media a point of them parts is found by asking each mesh
// whether it encloses what is right before and right behind the point, and a tracer in double goes by that. It knows no list of volumes.
#include <doctest/doctest.h>

#include <cmath>

#include "scene_text.hpp"
#include "split_oracle.hpp"
#include "surface.hpp"

using glm::dvec3;
using namespace test;

namespace {

// Bodies and media. Of two that enclose a point the one with the higher number is there.
enum Medium { kAir, kWhisky, kGlass, kIce };
const std::vector<SplitMedium> kMedia = {
    {1, dvec3(0)},
    {1.36, -glm::log(dvec3(0.8, 0.45, 0.12))},
    {1.5, -glm::log(dvec3(0.99, 0.995, 0.99))},
    {1.31, -glm::log(dvec3(0.98, 0.99, 1))},
};

/// The drink of the seed is the inside of the glass, larger by 1.2 % (some 0.01 on a radius of 0.88): how much larger it is to be, as a share
/// of that.
double scaleOf(double lap) {
    return (1 + 0.012 * lap) / 1.012;
}

/// Turned by this, in degrees, the flat sides of the drink are parallel to those of the glass, so that it can lap in by less than they bulge.
constexpr double kTurn = 0.5309;

const View kView{{0, 0, 8}, {0, 0, 0}, 18, 48, {0, 1, 0}, 10};

std::string fill(Medium medium) {
    return R"({"model":"pbr","roughness":0,"transmission":1,"ior":)" + json(kMedia[medium].ior) + R"(,"attenuationColor":)" +
           json(glm::exp(-kMedia[medium].sigma)) + "}";
}

std::string mesh(const char* name, const char* material, double scale, double turn, int priority) {
    return R"({"mesh":")" + (sharedDir() / "scenes/seed" / name).string() + R"(","material":")" + material +
           R"(","smooth":false,"scale":)" + json(scale) + R"(,"rotate":[0,)" + json(turn) + R"(,0],"priority":)" +
           std::to_string(priority) + "}";
}

/// `priority`: of the whisky over the glass.
std::string sceneOf(double lap, int priority) {
    return "{" + kView.text() + R"(,"background":{"color":[0.25,0.25,0.25]},"lights":[)" +
           pointLight({0, 0, -4}, {40, 40, 40}, "inverse-square") + R"(],"materials":{"glass":)" + fill(kGlass) +
           R"(,"whisky":)" + fill(kWhisky) + R"(,"ice":)" + fill(kIce) +
           R"(,"wall":{"model":"phong","diffuse":0.5}},"objects":[)" +
           mesh("water.obj", "whisky", scaleOf(lap), kTurn, priority) + "," + mesh("glass.obj", "glass", 1, 0, 0) + "," +
           mesh("ice.obj", "ice", 1, 0, 2) + "," + rectangle({-30, -30, -6}, {60, 0, 0}, {0, 60, 0}, "wall") + "]}";
}

/// The meshes of the scene as the compiler places them.
class Drink {
public:
    Drink(const TemporaryDir& dir, double lap) {
        dir.write("drink.json", sceneOf(lap, 0));
        minirtc::Diagnostics diagnostics;
        const minirtc::Geometry geometry =
            minirtc::flatten(minirtc::loadScene(dir.path() / "drink.json", diagnostics), diagnostics);
        origin_ = geometry.origin;
        std::vector<std::vector<minirtc::Primitive>> bodies(4);
        for (const minirtc::Primitive& t : geometry.primitives) {
            if (t.body > 2) continue;  // the wall
            bodies[t.body + 1].push_back(t);
            faces_.push_back({dvec3(t.p[0]), dvec3(t.p[1]), dvec3(t.p[2])});
        }
        for (const std::vector<minirtc::Primitive>& body : bodies) surfaces_.emplace_back(body, 1);
    }

    const std::vector<SplitFace>& faces() const { return faces_; }  // relative to `origin`
    const dvec3& origin() const { return origin_; }

    Sides sidesAt(const SplitFace& face, const dvec3& p) const {
        constexpr double kBeside = 1e-6;
        const dvec3 n = kBeside * glm::normalize(glm::cross(face.b - face.a, face.c - face.a));
        return {mediumAt(p + n), mediumAt(p - n)};
    }

private:
    Medium mediumAt(const dvec3& p) const {
        for (const Medium medium : {kIce, kGlass, kWhisky})
            if (surfaces_[medium].windingAt(p).value_or(0) > 0) return medium;
        return kAir;
    }

    dvec3 origin_{0};
    std::vector<SplitFace> faces_;
    std::vector<minirtc::Surface> surfaces_;
};

struct Comparison {
    double mean = 0;     // of the difference
    size_t differ = 0;   // pixels with over 2 % of difference
    size_t inGlass = 0;  // pixels that do not show what is around
};

Comparison compare(const Picture& picture, const std::vector<dvec3>& expected) {
    Comparison result;
    for (uint32_t i = 0; i < expected.size(); ++i) {
        const dvec3 seen(picture.at(i % kView.size, i / kView.size));
        const dvec3 around = litWall(kView.position, kView.direction(i % kView.size, i / kView.size));
        const double difference = glm::length(seen - expected[i]);
        result.mean += difference / static_cast<double>(expected.size());
        result.differ += difference > 0.02 * glm::length(expected[i]) ? 1 : 0;
        result.inGlass += glm::length(expected[i] - around) > 1e-6 ? 1 : 0;
    }
    return result;
}

std::vector<dvec3> splitPicture(const TemporaryDir& dir, double lap) {
    const Drink drink(dir, lap);
    SplitScene scene(
        drink.faces(), kMedia, [&](const dvec3& p, const dvec3& d) { return litWall(p + drink.origin(), d); },
        [&](const SplitFace& face, const dvec3& p) { return drink.sidesAt(face, p); });
    std::vector<dvec3> pixels;
    for (uint32_t y = 0; y < kView.size; ++y)
        for (uint32_t x = 0; x < kView.size; ++x)
            pixels.push_back(
                scene.radiance(kView.position - drink.origin(), kView.direction(x, y), static_cast<int>(kView.maxDepth)));
    CHECK(scene.misfits() == 0);
    return pixels;
}

}  // namespace

TEST_CASE("the seed's whisky equals its split interfaces, at once or linearly with how far the whisky laps into the glass") {
    if (!haveShared("scenes/seed/whisky.json")) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    constexpr double kLaps[] = {1, 0.5, 0.25, 0.125};
    double above[4];
    for (int i = 0; i < 4; ++i) {
        // The glass displaces the whisky: its wall is the interface whatever the lap. The other way round, it is off by the lap.
        const std::vector<dvec3> split = splitPicture(dir, kLaps[i]);
        const Comparison ordered = compare(renderScene(gpu, dir, sceneOf(kLaps[i], 0)), split);
        const Comparison reversed = compare(renderScene(gpu, dir, sceneOf(kLaps[i], 1)), split);
        MESSAGE("lap ", kLaps[i], ": ", ordered.inGlass, " pixels show the glass; mean difference ", ordered.mean, ", ",
                ordered.differ, " over 2 %; with the whisky above the glass ", reversed.mean, ", ", reversed.differ);
        CHECK(ordered.inGlass > 1500);
        CHECK(ordered.mean < 1e-5);
        CHECK(ordered.differ == 0);
        above[i] = reversed.mean;
    }
    for (int i = 1; i < 4; ++i) CHECK(above[i] < 0.8 * above[i - 1]);
    CHECK(above[0] / above[3] > 4);
}
