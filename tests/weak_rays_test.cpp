// Rays of Whitted's tracer that carry no more than the cut-off: those that play Russian roulette leave the picture right in the mean.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "scene_text.hpp"
#include "statistics.hpp"

using glm::dvec3;
using namespace minirtc;
using namespace test;

namespace {

/// Of "render": Whitted's tracer with `weak`, dropped or roulette.
std::string bakedWith(const View& view, const std::string& weak, const std::string& keys = "") {
    std::string text = view.text();
    const std::string key = quoted("render") + "{";
    return text.insert(text.find(key) + key.size(), keys + R"("accuracy":{"weak_rays":")" + weak + R"("},)");
}

/// Balls of a glass that disperses and absorbs, one in the other, and a mirror, under light that differs from place to place.
std::string glassScene(const std::string& weak, const std::string& keys = "") {
    const View view{{0, 1.5, 4}, {0, 0.6, 0}, 40, 16, {0, 1, 0}, 7};
    const std::string clear = R"({"model":"pbr","roughness":0,"transmission":1,)";
    return "{" + bakedWith(view, weak, keys) + R"(,"background":{"color":[0.5,0.6,0.7]},"lights":[)" +
           pointLight({2, 4, 3}, {20, 20, 20}, "inverse-square") +
           R"(],"materials":{"floor":{"model":"phong","diffuse":0.5,"reflect":0.2},"outer":)" + clear +
           R"("ior":1.5,"dispersion":1,"attenuationColor":[0.9,0.6,0.4]},"inner":)" + clear + R"("ior":1.2}},"objects":[)" +
           floorOf("floor") + "," + sphere({0, 0.9, 0}, 0.8, "outer") + "," + sphere({0.2, 0.9, 0.2}, 0.3, "inner") + "]}";
}

minirt_render_desc cutAt(float cutoff, uint32_t seed = 0) {
    minirt_render_desc desc = {};
    desc.throughput_cutoff = cutoff;
    desc.seed = seed;
    return desc;
}

/// The means of the picture's four quarters in each channel.
std::array<double, 12> quarters(const Picture& picture) {
    std::array<double, 12> sums = {};
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x)
            for (int k = 0; k < 3; ++k) {
                const size_t quarter = (2 * y < picture.height ? 0 : 2) + (2 * x < picture.width ? 0 : 1);
                sums[3 * quarter + static_cast<size_t>(k)] += picture.at(x, y)[k] * 4.0 / (picture.width * picture.height);
            }
    return sums;
}

/// The least p-value over the quarters of Student's test that pictures of many seeds have the mean `expected`.
double leastP(const LoadedScene& scene, float cutoff, const std::array<double, 12>& expected) {
    constexpr int kSeeds = 64;
    std::array<double, 12> sum = {}, squares = {};
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        const std::array<double, 12> found = quarters(scene.render(cutAt(cutoff, seed)));
        for (size_t i = 0; i < found.size(); ++i) {
            sum[i] += found[i] - expected[i];
            squares[i] += (found[i] - expected[i]) * (found[i] - expected[i]);
        }
    }
    double least = 1;
    for (size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / kSeeds;
        const double variance = (squares[i] / kSeeds - mean * mean) / (kSeeds - 1);
        if (std::abs(mean) <= 1e-6 * expected[i]) continue;  // what rounding alone leaves is no bias
        least = std::min(least, variance > 0 ? studentTail(mean / std::sqrt(variance), kSeeds - 1) : 0.0);
    }
    return least;
}

/// A sheet that mirrors and lets through the same share, under white: its pixels count the survivors of its two rays.
std::string sheetScene(double share) {
    const View view{{0, 0, 1}, {0, 0, 0}, 40, 64};
    return "{" + bakedWith(view, "roulette") +
           R"(,"background":{"color":[1,1,1]},"materials":{"m":{"model":"phong","diffuse":0,)" + R"("thin":true,"reflect":)" +
           json(share) + R"(,"refract":)" + json(share) + R"(}},"objects":[)" +
           rectangle({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, "m") + "]}";
}

}  // namespace

TEST_CASE("rays that play roulette leave the mean of the whole tree, which rays that are dropped do not") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    for (const std::string keys : {"", R"("dispersionMode":"spectral",)"}) {
        CAPTURE(keys);
        const LoadedScene dropping(gpu, bakeScene(dir, glassScene("dropped", keys)));
        const std::array<double, 12> whole = quarters(dropping.render(cutAt(-1)));
        const LoadedScene scene(gpu, bakeScene(dir, glassScene("roulette", keys)));
        for (const float cutoff : {0.05f, 0.4f}) {
            CAPTURE(cutoff);
            CHECK(leastP(scene, cutoff, whole) > sidakLevel(4 * 12));
        }
        CHECK(leastP(scene, 0.4f, quarters(dropping.render(cutAt(0.4f)))) < 1e-6);
    }
}

TEST_CASE("another seed draws other lots, where a ray is weak") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const LoadedScene roulette(gpu, bakeScene(dir, glassScene("roulette")));
    CHECK(roulette.render(cutAt(0.2f, 1)) == roulette.render(cutAt(0.2f, 1)));
    CHECK_FALSE(roulette.render(cutAt(0.2f, 1)) == roulette.render(cutAt(0.2f, 2)));
    CHECK(roulette.render(cutAt(-1, 1)) == roulette.render(cutAt(-1, 2)));
    const LoadedScene dropping(gpu, bakeScene(dir, glassScene("dropped")));
    CHECK(dropping.render(cutAt(0.2f, 1)) == dropping.render(cutAt(0.2f, 2)));
    CHECK(dropping.render(cutAt(-1)) == roulette.render(cutAt(-1)));
}

TEST_CASE("of two weak rays each survives with its share of the cut-off, and as seldom as can be both or none") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const struct {
        double share;
        std::vector<double> shares;  // of pixels with none, one, two survivors
    } cases[] = {{0.5, {0, 1, 0}}, {0.25, {0.5, 0.5, 0}}, {0.75, {0, 0.5, 0.5}}};
    for (const auto& one : cases) {
        CAPTURE(one.share);
        const Picture picture = LoadedScene(gpu, bakeScene(dir, sheetScene(one.share))).render(cutAt(1));
        std::vector<double> counts(3), expected;
        for (uint32_t i = 0; i < 64 * 64; ++i) {
            const float survivors = picture.at(i % 64, i / 64).r;
            REQUIRE((survivors == 0 || survivors == 1 || survivors == 2));
            counts[static_cast<size_t>(survivors)] += 1;
        }
        for (size_t k = 0; k < 3; ++k) {
            if (one.shares[k] == 0) CHECK(counts[k] == 0);
            expected.push_back(one.shares[k] * 64 * 64);
        }
        if (one.share != 0.5) CHECK(chiSquaredP(counts, expected) > sidakLevel(2));
    }
}
