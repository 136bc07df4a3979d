// Tables of lights to pick from, judged by powers and integrals that this file computes by itself.
#include "light_table.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "alias_table.hpp"
#include "random.hpp"
#include "statistics.hpp"
#include "support.hpp"

using namespace minirtc;

namespace {

constexpr double kPi = glm::pi<double>();

/// With which each entry is picked, by what is in the table.
std::vector<double> picked(const std::vector<AliasEntry>& table) {
    std::vector<double> p(table.size(), 0.0);
    const double n = static_cast<double>(table.size());
    for (size_t i = 0; i < table.size(); ++i) {
        p[i] += table[i].threshold / 4294967296.0 / n;
        p[table[i].alias] += (4294967296.0 - table[i].threshold) / 4294967296.0 / n;
    }
    return p;
}

std::vector<AliasEntry> aliases(const std::vector<minirt_pick>& rows) {
    std::vector<AliasEntry> table;
    for (const minirt_pick& row : rows) table.push_back({row.entry.y, row.entry.z});
    return table;
}

float stated(const minirt_pick& row) {
    float p;
    std::memcpy(&p, &row.entry.w, sizeof p);
    return p;
}

/// The largest |picked - asked|, relative to the larger of asked and the mean.
double worstError(const std::vector<double>& weights) {
    const std::vector<double> p = picked(aliasTable(weights));
    double total = 0, worst = 0;
    for (const double weight : weights) total += weight;
    for (size_t i = 0; i < p.size(); ++i) {
        const double asked = weights[i] / total;
        worst = std::max(worst, std::abs(p[i] - asked) / std::max(asked, 1.0 / static_cast<double>(p.size())));
        if ((weights[i] > 0) != (p[i] > 0)) return 1;
    }
    return worst;
}

Image image(uint32_t width, uint32_t height, const std::function<glm::vec3(uint32_t, uint32_t)>& color) {
    Image result;
    result.width = width, result.height = height;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) result.texels.emplace_back(color(x, y), 1.0f);
    return result;
}

Scene under(const Image& background) {
    Scene scene;
    scene.images = {background};
    scene.background.image = 0;
    return scene;
}

/// Luminance of the filtered panorama.
double seen(const Image& image, double u, double v) {
    const auto texel = [&](double x, double y) {
        const int w = static_cast<int>(image.width), h = static_cast<int>(image.height);
        const int column = (static_cast<int>(x) % w + w) % w, row = std::min(std::max(static_cast<int>(y), 0), h - 1);
        const glm::vec4& t = image.texels[static_cast<size_t>(row) * w + column];
        return 0.2126 * t.r + 0.7152 * t.g + 0.0722 * t.b;
    };
    const double x = u * image.width - 0.5, y = std::min(std::max(v, 0.0), 1.0) * image.height - 0.5;
    const double fx = x - std::floor(x), fy = y - std::floor(y), x0 = std::floor(x), y0 = std::floor(y);
    return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
           (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

/// The integral over a cell, by midpoints.
double bruteForce(const Image& image, const EnvironmentCells& cells, uint32_t i, uint32_t j, int steps) {
    double sum = 0;
    for (int b = 0; b < steps; ++b) {
        const double v = (j + (b + 0.5) / steps) / cells.rows;
        for (int a = 0; a < steps; ++a)
            sum += seen(image, (i + (a + 0.5) / steps) / cells.columns, v) * 2 * kPi * kPi * std::sin(kPi * v);
    }
    return sum / (static_cast<double>(steps) * steps * cells.columns * cells.rows);
}

Primitive triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, uint32_t material) {
    Primitive primitive;
    primitive.p = {a, b, c};
    primitive.material = material;
    return primitive;
}

Primitive ball(const glm::vec3& center, float radius, uint32_t material) {
    Primitive primitive = triangle(center, {radius, 0, 0}, {0, 0, 0}, material);
    primitive.isSphere = true;
    return primitive;
}

/// A scene of materials 0 (dark), 1 (shines), 2 (shines on both sides), and a cube of side 2 as its bounds.
struct Lit {
    Scene scene;
    Geometry geometry;

    Lit() {
        scene.materials.resize(3);
        scene.materials[1].emission = {1, 2, 3};
        scene.materials[2].emission = {0.25f, 0, 0};
        scene.materials[2].doubleSided = true;
        geometry.boundsMin = glm::vec3(-1), geometry.boundsMax = glm::vec3(1);
        geometry.primitives = {triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0)};
    }
    LightTable table() const { return lightTable(scene, geometry, bvh(), environmentCells(scene)); }
    Bvh bvh() const { return buildBvh(geometry, 1); }
};

double luminanceOf(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// W of a spot, by a sum over the angle from its axis.
double spotPower(const Light& spot) {
    const double inner = std::cos(glm::radians(spot.innerCone)), outer = std::cos(glm::radians(spot.outerCone));
    const int steps = 200000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = kPi * (i + 0.5) / steps;
        const double ramp = std::min(std::max((std::cos(angle) - outer) / (inner - outer), 0.0), 1.0);
        sum += ramp * ramp * 2 * kPi * std::sin(angle) * kPi / steps;
    }
    return sum * luminanceOf(spot.intensity);
}

}  // namespace

TEST_CASE("an alias table picks by weight to 1e-7") {
    CHECK(worstError({3}) < 1e-7);
    CHECK(worstError({1, 1}) < 1e-7);
    CHECK(worstError({0, 1e-300, 0}) < 1e-7);
    CHECK(worstError({1e300, 5e307, 5e307}) < 1e-7);
    CHECK(worstError({1, 1e-15}) < 1e-7);
    test::Random random(7);
    for (const size_t n : {3u, 10u, 1000u, 100000u}) {
        for (const double spread : {0.0, 3.0, 30.0}) {
            std::vector<double> weights;
            for (size_t i = 0; i < n; ++i) weights.push_back(random.uniform() < 0.2 ? 0 : std::exp(spread * random.uniform()));
            weights[n / 2] = 1;
            CAPTURE(n);
            CAPTURE(spread);
            CHECK(worstError(weights) < 1e-7);
        }
    }
}

TEST_CASE("draws from an alias table follow its weights") {
    test::Random random(11);
    std::vector<double> weights, counts(200, 0.0), expected;
    double total = 0;
    for (size_t i = 0; i < counts.size(); ++i) weights.push_back(i % 7 == 0 ? 0 : std::pow(1.05, static_cast<double>(i)));
    for (const double weight : weights) total += weight;
    const std::vector<AliasEntry> table = aliasTable(weights);
    const int draws = 1000000;
    for (int k = 0; k < draws; ++k) {
        const uint32_t i = random.index(static_cast<uint32_t>(table.size()));
        const auto word = static_cast<uint32_t>(random.uniform() * 4294967296.0);
        ++counts[word < table[i].threshold ? i : table[i].alias];
    }
    for (const double weight : weights) expected.push_back(draws * weight / total);
    for (size_t i = 0; i < counts.size(); i += 7) CHECK(counts[i] == 0);
    CHECK(test::chiSquaredP(counts, expected) > test::sidakLevel(1));
}

TEST_CASE("lights are picked by their power and a surface evenly over its area") {
    Lit lit;
    const std::vector<Primitive> shapes = {triangle({0, 0, 0}, {1, 0, 0}, {0, 0.5f, 0}, 1),
                                           triangle({0, 0, 1}, {0, 0.5f, 1}, {0.1f, 0, 1}, 1), ball({0, 0, 0}, 0.5f, 1),
                                           triangle({0, 0, -1}, {1, 0, -1}, {0, 1, -1}, 2)};
    lit.geometry.primitives.insert(lit.geometry.primitives.end(), shapes.begin(), shapes.end());
    Light light;
    light.intensity = {2, 1, 4};
    const double point = luminanceOf(light.intensity), r2 = 3;
    std::vector<double> powers = {0, kPi * luminanceOf({1, 2, 3}) * 0.25, kPi * luminanceOf({1, 2, 3}) * 0.025,
                                  kPi * luminanceOf({1, 2, 3}) * kPi, kPi * luminanceOf({0.25, 0, 0}) * 0.5 * 2};
    lit.scene.lights.push_back(light);
    powers.push_back(4 * kPi * point);
    light.inverseSquare = false;
    lit.scene.lights.push_back(light);
    powers.push_back(4 * kPi * point * r2);
    light.type = LightType::directional;
    lit.scene.lights.push_back(light);
    powers.push_back(kPi * r2 * point);
    light.type = LightType::spot;
    light.inverseSquare = true;
    light.innerCone = 20, light.outerCone = 70;
    lit.scene.lights.push_back(light);
    powers.push_back(spotPower(light));
    light.innerCone = light.outerCone = 90;
    lit.scene.lights.push_back(light);
    powers.push_back(2 * kPi * point);
    light.intensity = {0, 0, 0};
    lit.scene.lights.push_back(light);
    lit.scene.background.color = {0.01f, 0.02f, 0.03f};
    powers.push_back(kPi * r2 * 4 * kPi * luminanceOf(lit.scene.background.color));

    double total = 0;
    for (const double power : powers) total += power;
    const LightTable table = lit.table();
    const Bvh bvh = lit.bvh();
    const std::vector<double> p = picked(aliases(table.emitters));
    REQUIRE(table.emitters.size() == 4 + 5 + 1);
    for (size_t i = 0; i < p.size(); ++i) {
        const uint32_t entry = table.emitters[i].entry.x, index = entry & MINIRT_EMITTER_INDEX;
        const uint32_t kind = entry & ~MINIRT_EMITTER_INDEX;
        const size_t place = kind == MINIRT_EMITTER_PRIMITIVE ? bvh.order[index] : kind == MINIRT_EMITTER_LIGHT ? 5 + index : 10;
        CAPTURE(place);
        CHECK(std::abs(p[i] * total / powers[place] - 1) < 1e-6);
        CHECK(std::abs(stated(table.emitters[i]) * total / powers[place] - 1) < 1e-6);
        if (kind != MINIRT_EMITTER_PRIMITIVE) continue;
        const Primitive& shape = lit.geometry.primitives[place];
        const double areas[] = {0, 0.25, 0.025, kPi, 0.5};
        CHECK(std::abs(p[i] / (table.densities[shape.material] * areas[place]) - 1) < 1e-6);
    }
    CHECK(table.densities[0] == 0);
    CHECK(table.environment == doctest::Approx(powers.back() / total));
}

TEST_CASE("a triangle in several leaves shines once") {
    Lit lit;
    lit.geometry.primitives.push_back(triangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1));
    lit.geometry.primitives.push_back(triangle({0, 0, 0}, {0, 0.5f, 0}, {0, 0, 0.5f}, 1));
    Bvh bvh;
    bvh.order = {1, 0, 2, 1, 1};  // all that a table reads of it
    const LightTable table = lightTable(lit.scene, lit.geometry, bvh, environmentCells(lit.scene));
    const std::vector<double> p = picked(aliases(table.emitters));
    REQUIRE(p.size() == 2);
    CHECK((table.emitters[0].entry.x & MINIRT_EMITTER_INDEX) == 0);
    CHECK((table.emitters[1].entry.x & MINIRT_EMITTER_INDEX) == 2);
    CHECK(p[0] == doctest::Approx(0.8));
    CHECK(table.densities[1] == doctest::Approx(1 / 0.625));  // of area, over both
}

TEST_CASE("where nothing shines the environment is what is picked") {
    const LightTable table = Lit().table();
    REQUIRE(table.emitters.size() == 1);
    CHECK(table.emitters[0].entry.x == MINIRT_EMITTER_ENVIRONMENT);
    CHECK(table.environment == 1);
    const std::vector<minirt_pick> cells = environmentTable(environmentCells(Lit().scene));
    REQUIRE(cells.size() == 1);
    CHECK(stated(cells[0]) == 1);
}

TEST_CASE("a light of the faintest share still has a probability") {
    Lit lit;
    lit.scene.lights.resize(2);
    lit.scene.lights[0].intensity = glm::vec3(1e-30f);
    lit.scene.lights[1].intensity = glm::vec3(1e30f);
    lit.scene.materials[1].emission = glm::vec3(1e-37f);
    lit.geometry.primitives.push_back(triangle({0, 0, 0}, {1e-6f, 0, 0}, {0, 1e-6f, 0}, 1));
    const LightTable table = lit.table();
    REQUIRE(table.emitters.size() == 3);
    for (const minirt_pick& row : table.emitters) CHECK(stated(row) > 0);
    for (const double p : picked(aliases(table.emitters))) CHECK(p > 0);
    CHECK(table.densities[1] > 0);
}

TEST_CASE("an emissive texture counts by its mean and a black one does not count") {
    Lit lit;
    lit.scene.materials[1].emissionTexture = 0;
    lit.geometry.primitives.push_back(triangle({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 1));
    lit.geometry.primitives.push_back(triangle({0, 0, 1}, {2, 0, 1}, {0, 1, 1}, 2));
    lit.scene.images = {image(2, 2, [](uint32_t x, uint32_t y) { return glm::vec3(x == 1 && y == 1 ? 1.0f : 0.0f); })};
    const double ratio = luminanceOf({1, 2, 3}) / 4 / (2 * luminanceOf({0.25, 0, 0}));
    LightTable table = lit.table();
    REQUIRE(table.emitters.size() == 2);
    CHECK(table.densities[1] / double{table.densities[2]} == doctest::Approx(ratio).epsilon(1e-6));
    lit.scene.images[0] = image(1, 1, [](uint32_t, uint32_t) { return glm::vec3(0); });
    table = lit.table();
    REQUIRE(table.emitters.size() == 1);
    CHECK(table.densities[1] == 0);
}

TEST_CASE("a checker that shines is picked as a whole and its materials know how densely") {
    const test::TemporaryDir dir;
    Diagnostics diagnostics;
    const Scene scene =
        loadScene(dir.write("s.json", R"({"materials":{"lamp":{"model":"pbr","emissive":[4,4,4]},"dark":{"model":"pbr"},
        "tiles":{"model":"checker","a":"lamp","b":"dark"},"same":{"model":"checker","a":"lamp","b":"lamp"}},"objects":[
        {"rectangle":{"u":[2,0,0],"v":[0,1,0]},"material":"tiles"},{"rectangle":{"u":[1,0,0],"v":[0,3,0]},"material":"lamp"}]})"),
                  diagnostics);
    const Geometry geometry = flatten(scene, diagnostics);
    const LightTable table = lightTable(scene, geometry, buildBvh(geometry, 1), environmentCells(scene));
    const Material& tiles = scene.materials[2];
    CHECK(scene.materials[tiles.checkerA].name == "lamp in tiles");
    CHECK(scene.materials[tiles.checkerB].name == "dark in tiles");
    CHECK(table.densities[tiles.checkerA] == table.densities[tiles.checkerB]);
    // 3 m2 of lamp and 2 m2 of which half shines.
    CHECK(table.densities[0] == doctest::Approx(1.0 / 4).epsilon(1e-6));
    CHECK(table.densities[tiles.checkerA] == doctest::Approx(0.5 / 4).epsilon(1e-6));
    CHECK(scene.materials[3].checkerA != scene.materials[3].checkerB);
    CHECK(scene.materials[scene.materials[3].checkerB].emission == glm::vec3(4));
}

TEST_CASE("an emitter of 100,000 triangles is baked at once") {
    Lit lit;
    test::Random random(3);
    lit.geometry.primitives.clear();
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 p(random.inCube());
        lit.geometry.primitives.push_back(triangle(p, p + glm::vec3(random.inCube(0.01)), p + glm::vec3(random.inCube(0.01)), 1));
    }
    const Bvh bvh = lit.bvh();
    const auto begin = std::chrono::steady_clock::now();
    const LightTable table = lightTable(lit.scene, lit.geometry, bvh, environmentCells(lit.scene));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    MESSAGE("seconds: ", seconds);
    CHECK(seconds < 1);
    REQUIRE(table.emitters.size() == 100000);
    double sum = 0;
    for (const minirt_pick& row : table.emitters) sum += stated(row);
    CHECK(sum == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("cells of the environment weigh what a sum over the filtered image finds") {
    test::Random random(5);
    const auto noise = [&](uint32_t, uint32_t) { return glm::vec3(random.inCube(0.5) + 0.5); };
    for (const auto& [width, height] : {std::pair{1u, 1u}, {2u, 1u}, {7u, 5u}, {16u, 8u}, {1, 40}, {1500u, 3u}, {5u, 700u}}) {
        CAPTURE(width);
        CAPTURE(height);
        const Scene scene = under(image(width, height, noise));
        const EnvironmentCells cells = environmentCells(scene);
        CHECK(cells.columns == std::min(width, 1024u));
        CHECK(cells.rows == std::min(height, 512u));
        double worst = 0;
        for (uint32_t k = 0; k < cells.weights.size(); k += 1 + static_cast<uint32_t>(cells.weights.size()) / 50) {
            const int steps = width * height == 1 ? 400 : 200;
            const double sum = bruteForce(scene.images[0], cells, k % cells.columns, k / cells.columns, steps);
            worst = std::max(worst, std::abs(cells.weights[k] / sum - 1));
        }
        CHECK(worst < 1e-4);
    }
    const Scene grey = under(image(12, 6, [](uint32_t, uint32_t) { return glm::vec3(2); }));
    CHECK(environmentCells(grey).total == doctest::Approx(8 * kPi).epsilon(1e-12));
}

TEST_CASE("the environment's strength counts and a constant one is one cell") {
    Scene scene = under(image(4, 2, [](uint32_t, uint32_t) { return glm::vec3(1); }));
    scene.background.strength = 3;
    CHECK(environmentCells(scene).total == doctest::Approx(12 * kPi).epsilon(1e-12));
    scene.background = {};
    scene.background.color = {1, 1, 1};
    const EnvironmentCells cells = environmentCells(scene);
    CHECK(cells.weights.size() == 1);
    CHECK(cells.total == doctest::Approx(4 * kPi).epsilon(1e-12));
}

TEST_CASE("a black environment is no light and its cells are alike") {
    Lit lit;
    lit.scene.images = {image(4, 2, [](uint32_t, uint32_t) { return glm::vec3(0); })};
    lit.scene.background.image = 0;
    lit.scene.lights.resize(1);
    const EnvironmentCells cells = environmentCells(lit.scene);
    CHECK(cells.total == 0);
    for (const minirt_pick& cell : environmentTable(cells)) CHECK(stated(cell) == 0.125f);
    const LightTable table = lit.table();
    REQUIRE(table.emitters.size() == 1);
    CHECK(table.emitters[0].entry.x == MINIRT_EMITTER_LIGHT);
    CHECK(table.environment == 0);
}

TEST_CASE("of one bright texel every cell is picked that filtering lets it shine in") {
    struct Case {
        uint32_t width, height, x, y;
    };
    for (const Case& c : {Case{16, 8, 5, 3}, Case{16, 8, 0, 0}, Case{16, 8, 15, 7}, Case{1, 1, 0, 0}, Case{3, 700, 1, 320},
                          Case{1500, 4, 1499, 2}, Case{2048, 4, 512, 1}}) {
        CAPTURE(c.width);
        CAPTURE(c.x);
        const Scene scene = under(
            image(c.width, c.height, [&](uint32_t x, uint32_t y) { return glm::vec3(x == c.x && y == c.y ? 1.0f : 0.0f); }));
        const EnvironmentCells cells = environmentCells(scene);
        const std::vector<minirt_pick> rows = environmentTable(cells);
        const std::vector<double> p = picked(aliases(rows));
        int wrong = 0, lit = 0;
        for (uint32_t k = 0; k < p.size(); ++k) {
            const bool shines = bruteForce(scene.images[0], cells, k % cells.columns, k / cells.columns, 32) > 0;
            lit += shines;
            wrong += (p[k] > 0) != shines || (stated(rows[k]) > 0) != shines;
        }
        CHECK(wrong == 0);
        CHECK(lit >= (c.width == 1 ? 1 : 2));
        CHECK(lit <= 9);
    }
}
