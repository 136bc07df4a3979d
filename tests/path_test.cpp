// Pictures of the path tracer against closed forms, and against what its other ways of finding light give.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "path_scene.hpp"
#include "statistics.hpp"

using glm::dvec3;
using namespace test;

namespace {

constexpr std::array<uint32_t, 4> kStrategies = {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_MIS_BALANCE,
                                                 MINIRT_LIGHT_SAMPLING_LIGHTS, MINIRT_LIGHT_SAMPLING_SURFACES};

/// The mean over a pixel of what `radiance` gives for the points of the floor y = 0 that it shows.
std::optional<dvec3> overPixel(const View& view, uint32_t x, uint32_t y, const std::function<dvec3(const dvec3&)>& radiance) {
    constexpr uint32_t kSplit = 8;
    View fine = view;
    fine.size *= kSplit;
    dvec3 sum(0);
    for (uint32_t i = 0; i < kSplit * kSplit; ++i) {
        const dvec3 d = fine.direction(x * kSplit + i % kSplit, y * kSplit + i / kSplit);
        sum += radiance(view.position - view.position.y / d.y * d);
    }
    return sum / double{kSplit * kSplit};
}

/// Irradiance at p under the normal n from a polygon of radiance 1 that lies above the horizon (Lambert 1760): each edge gives the angle under
/// which it is seen times the cosine between n and the normal of the plane through p and the edge.
double polygonIrradiance(const dvec3& p, const dvec3& n, const std::vector<dvec3>& corners) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const dvec3 a = glm::normalize(corners[i] - p), b = glm::normalize(corners[(i + 1) % corners.size()] - p);
        sum += std::acos(glm::dot(a, b)) * glm::dot(n, glm::normalize(glm::cross(a, b)));
    }
    return std::abs(sum) / 2;
}

/// Irradiance at p on a floor from a sphere of radiance 1 above the horizon: what a disk of its solid angle gives.
double sphereIrradiance(const dvec3& p, const dvec3& center, double radius) {
    const dvec3 away = center - p;
    const double d2 = glm::dot(away, away);
    return kPi * radius * radius / d2 * away.y / std::sqrt(d2);
}

/// The picture of a floor against a closed form: its mean to 0.5 %, each pixel to 6 %, which leaves room for noise.
void checkFloor(const View& view, const Picture& picture, const std::function<dvec3(const dvec3&)>& radiance) {
    dvec3 expected(0);
    for (uint32_t y = 0; y < view.size; ++y)
        for (uint32_t x = 0; x < view.size; ++x)
            expected += *overPixel(view, x, y, radiance) / static_cast<double>(view.size * view.size);
    const dvec3 ratio = meanOf(picture) / expected;
    MESSAGE("mean over the closed form: ", ratio.x, " ", ratio.y, " ", ratio.z);
    for (int k = 0; k < 3; ++k) CHECK(std::abs(ratio[k] - 1) < 0.005);
    checkPixels(picture, 0.06, [&](uint32_t x, uint32_t y) { return overPixel(view, x, y, radiance); });
}

const dvec3 kUp(0, 1, 0);
const dvec3 kAlbedo(0.8, 0.5, 0.2);

/// Looks down on the floor near the origin; what is over x = 1 is not seen.
const View kFloorView{{-1.5, 2, 1}, {0, 0, 0}, 25, 8, {0, 1, 0}, 0, 4096};

struct Slanted {
    dvec3 origin{1, 1, -1}, u{0, 0.5, 2}, v{1.5, 0.75, 0};
    std::vector<dvec3> corners() const { return {origin, origin + u, origin + u + v, origin + v}; }
    std::string light(const dvec3& radiance) const {
        return dot(cross(u, v), kUp) < 0 ? rectangleLight(origin, u, v, radiance) : rectangleLight(origin, v, u, radiance);
    }
};

}  // namespace

TEST_CASE("a rectangle lights a floor by Lambert's formula") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const Slanted lamp;
    const dvec3 radiance(3, 5, 7);
    const LoadedScene scene(gpu, bakeScene(dir, pathScene(kFloorView, R"("lights":[)" + lamp.light(radiance) + "]," +
                                                                          only(lambert(kAlbedo), floorOf("m")))));
    for (const uint32_t strategy : {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_LIGHTS})
        checkFloor(kFloorView, renderPath(scene, 4096, strategy),
                   [&](const dvec3& p) { return kAlbedo * radiance * (polygonIrradiance(p, kUp, lamp.corners()) / kPi); });
}

TEST_CASE("a sphere lights a floor as the solid angle under which it is seen") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const dvec3 center(1.5, 1.25, -0.5), radiance(3, 5, 7);
    for (const double radius : {1.0, 0.05}) {
        const LoadedScene scene(
            gpu, bakeScene(dir, pathScene(kFloorView, R"("lights":[)" + sphereLight(center, radius, radiance) + "]," +
                                                          only(lambert(kAlbedo), floorOf("m")))));
        for (const uint32_t strategy : {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_LIGHTS})
            checkFloor(kFloorView, renderPath(scene, 4096, strategy),
                       [&](const dvec3& p) { return kAlbedo * radiance * (sphereIrradiance(p, center, radius) / kPi); });
    }
}

TEST_CASE("a constant environment lights a floor but for what a black ball hides") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const dvec3 center(1.5, 1.25, -0.5);
    const LoadedScene scene(
        gpu, bakeScene(dir, pathScene(kFloorView, background(2) + R"(,"materials":{"m":)" + lambert(kAlbedo) + R"(,"black":)" +
                                                      lambert(dvec3(0)) + R"(},"objects":[)" + floorOf("m") + "," +
                                                      sphere(center, 1, "black") + "]")));
    for (const uint32_t strategy : kStrategies)
        checkFloor(kFloorView, renderPath(scene, 4096, strategy),
                   [&](const dvec3& p) { return kAlbedo * (2 - 2 * sphereIrradiance(p, center, 1) / kPi); });
}

// ---- Energy ----

namespace {

/// Balls in a row, one a material, in a white room; each fills the middle of a square of 12 pixels.
std::string ballFurnace(const std::vector<std::string>& materials) {
    std::string named, balls;
    for (size_t i = 0; i < materials.size(); ++i) {
        const std::string name = "m" + std::to_string(i), comma = i ? "," : "";
        named += comma + quoted(name) + materials[i];
        balls += comma + sphere({2.4 * static_cast<double>(i) + 1.2, 0, 0}, 1, name);
    }
    const auto n = static_cast<double>(materials.size());
    return R"({"camera":{"position":)" + json(dvec3(1.2 * n, 0, 60)) + R"(,"target":)" + json(dvec3(1.2 * n, 0, 0)) +
           R"(,"vfov":)" + json(2 * glm::degrees(std::atan(0.02))) +
           R"(},"render":{"integrator":"path","maxDepth":255,"size":[)" + json(12 * n) + R"(,12]},)" + background(1) +
           R"(,"materials":{)" + named + R"(},"objects":[)" + balls + "]}";
}

/// Mean of the 6 x 6 pixels in the middle of ball i.
double ballMean(const Picture& picture, size_t i) {
    double sum = 0;
    for (uint32_t y = 3; y < 9; ++y)
        for (uint32_t x = 3; x < 9; ++x) sum += double{picture.at(12 * static_cast<uint32_t>(i) + x, y).y} / 36;
    return sum;
}

}  // namespace

TEST_CASE("white bodies without loss are not seen in a white room") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const std::vector<std::string> materials = {
        lambert(dvec3(1)), R"({"model":"phong","diffuse":0.25,"reflect":0.75})", pbr(R"("metallic":1,"roughness":0)"), glass(1.5),
        glass(0.7),        pbr(R"("transmission":1,"roughness":0,"thin":true)")};
    const LoadedScene scene(gpu, bakeScene(dir, ballFurnace(materials)));
    for (const uint32_t strategy : kStrategies) {
        const Picture picture = renderPath(scene, 4096, strategy);
        // Without its own samples a very smooth metal, which is no mirror, is seen by chance alone.
        const bool lightsAlone = strategy == MINIRT_LIGHT_SAMPLING_LIGHTS;
        for (size_t i = 0; i < (lightsAlone ? 2 : materials.size()); ++i) {
            CAPTURE(strategy);
            CAPTURE(materials[i]);
            CHECK(std::abs(ballMean(picture, i) - 1) <= (lightsAlone ? 1e-2 : 1e-3));
        }
    }
}

TEST_CASE("no surface gives more light than it gets, and rough ones lose what their model loses") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    // With the least that comes back: what fits leave of losses, and of glass what meets a second microfacet.
    const std::vector<std::pair<std::string, double>> kinds = {{R"("metallic":1,"roughness":0.3)", 0.99},
                                                               {R"("metallic":1,"roughness":0.6)", 0.99},
                                                               {R"("metallic":1,"roughness":1)", 0.99},
                                                               {R"("roughness":0)", 0.98},
                                                               {R"("roughness":0.3)", 0.98},
                                                               {R"("roughness":1)", 0.98},
                                                               {R"("transmission":1,"roughness":0.1)", 0.99},
                                                               {R"("transmission":1,"roughness":0.4)", 0.85},
                                                               {R"("transmission":0.5,"roughness":0.5)", 0.85}};
    std::vector<std::string> materials;
    for (const auto& kind : kinds) materials.push_back(pbr(kind.first));
    const LoadedScene scene(gpu, bakeScene(dir, ballFurnace(materials)));
    std::vector<Picture> pictures;
    for (uint32_t seed = 0; seed < 16; ++seed) pictures.push_back(renderPath(scene, 512, MINIRT_LIGHT_SAMPLING_MIS, seed));
    for (size_t i = 0; i < kinds.size(); ++i) {
        double sum = 0, squares = 0;
        for (const Picture& picture : pictures) {
            const double one = ballMean(picture, i);
            sum += one, squares += one * one;
        }
        const double count = static_cast<double>(pictures.size()), mean = sum / count;
        const double sigma = std::sqrt(std::max(squares / count - mean * mean, 0.0) / (count - 1));
        MESSAGE(kinds[i].first, ": ", mean, " +- ", sigma);
        CHECK(mean <= 1 + 1e-4 + 4 * sigma);
        CHECK(sigma <= 1e-3);
        CHECK(mean >= kinds[i].second);
    }
}

TEST_CASE("light finds its way out of a white box after any number of bounces") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0.1, 1.9, 0.2}, {0, 0, 0}, 60, 8, {0, 0, -1}, 255};
    const std::string box =
        rectangle({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, "m") + "," + rectangle({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, "m") + "," +
        rectangle({-1, 0, 1}, {2, 0, 0}, {0, 2, 0}, "m") + "," + rectangle({-1, 0, -1}, {0, 0, 2}, {0, 2, 0}, "m") + "," +
        rectangle({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, "m");
    const LoadedScene scene(gpu, bakeScene(dir, pathScene(view, background(1) + "," + only(lambert(dvec3(1)), box))));
    for (const uint32_t strategy : kStrategies) {
        CAPTURE(strategy);
        const double noise = strategy == MINIRT_LIGHT_SAMPLING_LIGHTS ? 1e-2 : 1e-3;
        CHECK(std::abs(meanOf(renderPath(scene, 4096, strategy)).y - 1) <= noise);
    }
}

// ---- Its own ways against each other ----

namespace {

/// Means of 4 x 4 tiles of a picture of 16 x 16, in all channels.
std::vector<double> tileMeans(const Picture& picture) {
    std::vector<double> means(48, 0.0);
    for (uint32_t y = 0; y < 16; ++y)
        for (uint32_t x = 0; x < 16; ++x)
            for (uint32_t k = 0; k < 3; ++k)
                means[(y / 4 * 4 + x / 4) * 3 + k] += double{picture.at(x, y)[static_cast<int>(k)]} / 16;
    return means;
}

/// By tile and channel, the means of independent pictures.
std::vector<std::vector<double>> tileSamples(const LoadedScene& scene, uint32_t pictures, uint32_t samples, uint32_t strategy,
                                             uint32_t firstSeed) {
    std::vector<std::vector<double>> list(48);
    for (uint32_t i = 0; i < pictures; ++i) {
        const std::vector<double> means = tileMeans(renderPath(scene, samples, strategy, firstSeed + i));
        for (size_t k = 0; k < means.size(); ++k) list[k].push_back(means[k]);
    }
    return list;
}

/// Welch's test for each tile and channel, at a level that rejects equal pictures once in a hundred.
void checkSameMeans(const std::string& what, const std::vector<std::vector<double>>& a,
                    const std::vector<std::vector<double>>& b) {
    double least = 1;
    for (size_t k = 0; k < a.size(); ++k) least = std::min(least, welchP(a[k], b[k]));
    MESSAGE(what, ": least p ", least);
    CHECK(least > sidakLevel(static_cast<int>(a.size())));
}

/// A bit of all that shines and reflects: lamps of both shapes and a mesh with smooth normals, a lit background; matt, coated, metal and glass.
std::string motley(const TemporaryDir& dir, const View& view) {
    return pathScene(
        view,
        background(0.2) + R"(,"lights":[)" + rectangleLight({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, {4, 5, 6}) + "," +
            sphereLight({2, 1, 1}, 0.25, {20, 10, 5}) + R"(],"materials":{"matt":)" + lambert(kAlbedo) +
            R"(,"metal":{"model":"pbr","metallic":1,"roughness":0.4,"baseColor":[0.9,0.7,0.3]},"coated":{"model":"pbr","roughness":0.25,"baseColor":[0.2,0.3,0.8]},)" +
            R"("phong":{"model":"phong","diffuse":0.6,"reflect":0.2},"frosted":{"model":"pbr","transmission":1,"roughness":0.3},"glow":)" +
            glow(3) + R"(},"objects":[)" + floorOf("matt") + "," + sphere({-1.5, 0.7, 0}, 0.7, "metal") + "," +
            sphere({0, 0.7, 0.5}, 0.7, "coated") + "," + sphere({1.5, 0.5, -1}, 0.5, "frosted") + "," +
            rectangle({-3, 0, -2}, {6, 0, 0}, {0, 3, 0}, "phong") + "," +
            box(dir, "lamp", {-0.9, 0.4, 1.2}, {-0.5, 0.8, 1.6}, "glow") + "]");
}

const View kMotleyView{{0, 2, 6}, {0, 0.8, 0}, 45, 16, {0, 1, 0}, 4};

}  // namespace

TEST_CASE("all ways to find light give the same picture") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, motley(dir, kMotleyView)));
    const auto mis = tileSamples(scene, 24, 64, MINIRT_LIGHT_SAMPLING_MIS, 1);
    checkSameMeans("balance", mis, tileSamples(scene, 24, 64, MINIRT_LIGHT_SAMPLING_MIS_BALANCE, 101));
    checkSameMeans("lights alone", mis, tileSamples(scene, 24, 64, MINIRT_LIGHT_SAMPLING_LIGHTS, 201));
    checkSameMeans("surfaces alone", mis, tileSamples(scene, 24, 256, MINIRT_LIGHT_SAMPLING_SURFACES, 301));
}

TEST_CASE("pictures of 1, 4 and 16 samples have the same mean") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, motley(dir, kMotleyView)));
    const auto four = tileSamples(scene, 48, 4, MINIRT_LIGHT_SAMPLING_MIS, 1);
    checkSameMeans("1 against 4", tileSamples(scene, 96, 1, MINIRT_LIGHT_SAMPLING_MIS, 1001), four);
    checkSameMeans("16 against 4", tileSamples(scene, 48, 16, MINIRT_LIGHT_SAMPLING_MIS, 2001), four);
}

// ---- Exact values ----

namespace {

/// So narrow that all its pixels show the same point to 2e-5 of their distance.
View narrow(const dvec3& position, const dvec3& target, uint32_t maxDepth = 4) {
    return View{position, target, 1e-3, 2, {0, 1, 0}, maxDepth};
}

void checkValue(const Picture& picture, const dvec3& expected, double tolerance) {
    const dvec3 mean = meanOf(picture);
    for (int k = 0; k < 3; ++k) CHECK(std::abs(mean[k] - expected[k]) <= tolerance * std::max(expected[k], 1e-3));
}

}  // namespace

TEST_CASE("without any light the picture is black") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0, 6}, {0, 0, 0}, 40, 16};
    const LoadedScene scene(
        gpu, bakeScene(dir, pathScene(view, R"("materials":{"a":)" + lambert(kAlbedo) + R"(,"b":)" + glass(1.5) + R"(,"c":)" +
                                                pbr(R"("roughness":0.2)") + R"(},"objects":[)" + sphere({-1, 0, 0}, 0.9, "a") +
                                                "," + sphere({1, 0, 0}, 0.9, "b") + "," + sphere({0, 1.5, 0}, 0.6, "c") + "]")));
    for (const uint32_t strategy : kStrategies) CHECK(meanOf(renderPath(scene, 4, strategy)) == dvec3(0));
}

TEST_CASE("lights without size on a Lambertian floor, exactly") {
    GpuContext gpu;
    if (!gpu) return;
    const View view = narrow({-1, 2, 1}, {0, 0, 0});
    const auto render = [&](const std::string& light, const std::string& material) {
        return renderScene(gpu, pathScene(view, R"("lights":[)" + light + "]," + only(material, floorOf("m"))));
    };
    const dvec3 position(0.5, 2, -1), intensity(10, 20, 30);
    const double d2 = glm::dot(position, position), cosine = position.y / std::sqrt(d2);
    checkValue(render(pointLight(position, intensity, "inverse-square"), lambert(kAlbedo)),
               kAlbedo * intensity * (cosine / d2 / kPi), 1e-4);
    checkValue(render(pointLight(position, intensity, "none"), lambert(kAlbedo)), kAlbedo * intensity * (cosine / kPi), 1e-4);
    checkValue(render(R"({"type":"directional","direction":[1,-2,2],"irradiance":[3,2,1]})", lambert(kAlbedo)),
               kAlbedo * dvec3(3, 2, 1) * (2.0 / 3 / kPi), 1e-4);
    // A spot that aims 20 degrees past the point; full to 10 degrees, dark from 40.
    const double angle = glm::radians(20.0), inner = std::cos(glm::radians(10.0)), outer = std::cos(glm::radians(40.0));
    const double t = (std::cos(angle) - outer) / (inner - outer);
    const dvec3 axis(std::sin(angle), -std::cos(angle), 0);
    checkValue(render(R"({"type":"spot","position":[0,2,0],"direction":)" + json(axis) +
                          R"(,"intensity":[10,20,30],"innerConeAngle":10,"outerConeAngle":40})",
                      lambert(kAlbedo)),
               kAlbedo * intensity * (t * t / 4 / kPi), 1e-4);
}

TEST_CASE("phong surfaces are lit by lights without size as in Whitted's model, by all else as Lambertian ones") {
    GpuContext gpu;
    if (!gpu) return;
    const View view = narrow({-1, 2, 1}, {0, 0, 0});
    const dvec3 position(0.5, 2, -1), intensity(10, 20, 30), color(1, 0.5, 0.25);
    const std::string material = R"({"model":"phong","diffuse":0.5,"specular":0.25,"shininess":8,"color":[1,0.5,0.25]})";
    const dvec3 toLight = glm::normalize(position), toEye = glm::normalize(view.position);
    const double lobe = std::pow(std::max(glm::dot(dvec3(-toLight.x, toLight.y, -toLight.z), toEye), 0.0), 8);
    checkValue(renderScene(gpu, pathScene(view, R"("lights":[)" + pointLight(position, intensity, "none") + "]," +
                                                    only(material, floorOf("m")))),
               color * intensity * (0.5 * toLight.y + 0.25 * lobe), 1e-4);
    const TemporaryDir dir;
    const LoadedScene room(gpu, bakeScene(dir, pathScene(view, background(2) + "," + only(material, floorOf("m")))));
    for (const uint32_t strategy : kStrategies)
        checkValue(renderPath(room, 65536, strategy), 0.5 * color * 2.0, strategy == MINIRT_LIGHT_SAMPLING_LIGHTS ? 1e-2 : 2e-3);
    const LoadedScene mirror(
        gpu, bakeScene(dir, pathScene(view, background(2) + "," +
                                                only(R"({"model":"phong","diffuse":0,"reflect":0.3})", floorOf("m")))));
    checkValue(renderPath(mirror, 16), dvec3(0.6), 1e-5);
}

TEST_CASE("emission is seen from the front, and from behind where it is double-sided") {
    GpuContext gpu;
    if (!gpu) return;
    for (const bool doubleSided : {false, true})
        for (const double side : {1.0, -1.0}) {
            const std::string lamp = R"({"model":"pbr","baseColor":[0,0,0],"emissive":[3,2,1],"doubleSided":)" +
                                     std::string(doubleSided ? "true" : "false") + "}";
            const Picture picture = renderScene(gpu, pathScene(narrow({0, 0, 4 * side}, {0, 0, 0}),
                                                               only(lamp, rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, "m"))));
            checkValue(picture, side > 0 || doubleSided ? dvec3(3, 2, 1) : dvec3(0), 1e-6);
        }
}

TEST_CASE("a sheet lets through what its alpha leaves, for the eye and for light") {
    GpuContext gpu;
    if (!gpu) return;
    const std::array<std::pair<std::string, double>, 3> kinds = {{{R"("alpha":0.25,"alphaMode":"blend")", 0.75},
                                                                  {R"("alpha":0.75,"alphaMode":"mask")", 0},
                                                                  {R"("alpha":0.75,"alphaMode":"mask","alphaCutoff":0.8)", 1}}};
    for (const auto& kind : kinds) {
        const std::string& alpha = kind.first;
        const double passes = kind.second;
        CAPTURE(alpha);
        const TemporaryDir dir;
        const std::string sheet = pbr(R"("ior":1,"baseColor":[0,0,0],)" + alpha);
        // The eye, at a lamp.
        const LoadedScene seen(
            gpu, bakeScene(dir, pathScene(narrow({0, 0, 4}, {0, 0, 0}),
                                          R"("lights":[)" + rectangleLight({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, dvec3(4)) + "]," +
                                              only(sheet, rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, "m")))));
        checkValue(renderPath(seen, 16384), dvec3(4 * passes), 0.01);
        // Light on its way to a floor under the sheet, from a point and a lamp.
        const Slanted lamp;
        const LoadedScene lit(
            gpu, bakeScene(dir, pathScene(narrow({0, 0.2, 1}, {0, 0, 0}, 0),
                                          R"("lights":[)" + lamp.light(dvec3(9)) + "," +
                                              pointLight({0, 2, 0}, dvec3(2), "inverse-square") + R"(],"materials":{"floor":)" +
                                              lambert(dvec3(1)) + R"(,"m":)" + sheet + R"(},"objects":[)" + floorOf("floor") +
                                              "," + rectangle({-30, 0.5, -30}, {0, 0, 60}, {60, 0, 0}, "m") + "]")));
        const double irradiance = 9 * polygonIrradiance(dvec3(0), kUp, lamp.corners()) + 0.5;
        for (const uint32_t strategy : {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_LIGHTS})
            checkValue(renderPath(lit, 65536, strategy), dvec3(passes * irradiance / kPi), 0.01);
    }
}

TEST_CASE("media take from paths what Beer and Lambert say") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const dvec3 left(0.5, 0.25, 1);  // of white light after a metre
    const auto slab = [&](double ior) {
        return pathScene(narrow({0, 0, 6}, {0, 0, 0}, 60), background(2) + "," +
                                                               only(R"({"model":"pbr","transmission":1,"roughness":0,"ior":)" +
                                                                        json(ior) + R"(,"attenuationColor":)" + json(left) + "}",
                                                                    box(dir, "slab", {-50, -50, -0.75}, {50, 50, 0.75}, "m")));
    };
    const dvec3 passed = glm::pow(left, dvec3(1.5));
    checkValue(renderScene(gpu, dir, slab(1)), 2.0 * passed, 1e-5);
    // Between two parallel faces light goes to and fro.
    const double f = fresnel(1, 1.5);
    const dvec3 through = (1 - f) * (1 - f) * passed / (1.0 - f * f * passed * passed);
    const dvec3 back = f + (1 - f) * (1 - f) * f * passed * passed / (1.0 - f * f * passed * passed);
    const LoadedScene scene(gpu, bakeScene(dir, slab(1.5)));
    checkValue(renderPath(scene, 65536), 2.0 * (through + back), 2e-3);
}

TEST_CASE("a lamp in a ball of glass is found by paths alone, and lights no less for it") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    // Equal indices: the ball is not there. All ways agree with Lambert's formula.
    const View view = narrow({0, 0.2, 1}, {0, 0, 0}, 4);
    const double radius = 0.2, expected = 30 * sphereIrradiance(dvec3(0), {0.5, 1, 0}, radius) / kPi;
    const auto scene = [&](double ior) {
        return pathScene(view, R"("lights":[)" + sphereLight({0.5, 1, 0}, radius, dvec3(30)) + R"(],"materials":{"floor":)" +
                                   lambert(dvec3(1)) + R"(,"m":)" + glass(ior) + R"(},"objects":[)" + floorOf("floor") + "," +
                                   sphere({0.5, 1, 0}, 0.5, "m") + "]");
    };
    const LoadedScene clear(gpu, bakeScene(dir, scene(1)));
    checkValue(renderPath(clear, 16384), dvec3(expected), 0.01);
    checkValue(renderPath(clear, 16384, MINIRT_LIGHT_SAMPLING_LIGHTS), dvec3(expected), 0.01);
    // Glass: no shadow ray reaches the lamp, so picking it adds nothing to what paths find.
    const LoadedScene bent(gpu, bakeScene(dir, scene(1.5)));
    const dvec3 surfaces = meanOf(renderPath(bent, 65536, MINIRT_LIGHT_SAMPLING_SURFACES)), mis = meanOf(renderPath(bent, 65536));
    CHECK(mis.y == doctest::Approx(surfaces.y).epsilon(0.03));
    CHECK(mis.y > 0.5 * expected);
}
