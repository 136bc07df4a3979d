// Light inside of nested media against closed forms: from JSON through minirtc to floats.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene_text.hpp"

using glm::dvec3;
using namespace test;

namespace {

constexpr double kGlass = 1.5, kWhisky = 1.36, kIce = 1.31;

/// Clear but for one channel: what the red, green and blue of a picture lose tells the way through glass, whisky and ice apart.
std::string medium(double ior, int channel) {
    dvec3 color(1);
    color[channel] = std::exp(-0.5);  // sigma = 0.5 / m there
    return R"({"model":"pbr","roughness":0,"transmission":1,"ior":)" + json(ior) + R"(,"attenuationColor":)" + json(color) + "}";
}

std::string media() {
    return R"("glass":)" + medium(kGlass, 0) + R"(,"whisky":)" + medium(kWhisky, 1) + R"(,"ice":)" + medium(kIce, 2);
}

std::string wallLight() {
    return pointLight({0, 0, -4}, {8, 8, 8}, "inverse-square");
}

/// Radiance of the wall z = -6 under wallLight.
double wallRadiance(const dvec3& p) {
    const double d2 = 4 + p.x * p.x + p.y * p.y;
    return 0.5 * 8 * 2 / std::sqrt(d2) / d2;
}

std::string wall() {
    return rectangle({-60, -60, -6}, {120, 0, 0}, {0, 120, 0}, "wall");
}

/// A ray after all interfaces.
struct Through {
    dvec3 p, d;
    double transmittance = 1;
    dvec3 lengths{0};  // in glass, whisky, ice
    bool total = false;

    dvec3 color() const { return transmittance * glm::exp(-0.5 * lengths) * wallRadiance(p + (-6 - p.z) / d.z * d); }
};

void refract(Through& ray, const dvec3& n, double from, double to) {
    const double cosI = -glm::dot(ray.d, n), eta = to / from, k = 1 - (1 - cosI * cosI) / (eta * eta);
    ray.total = ray.total || k <= 0;
    if (ray.total) return;
    ray.transmittance *= 1 - fresnel(cosI, eta);
    ray.d = glm::normalize(ray.d / eta + n * (cosI / eta - std::sqrt(k)));
}

/// Planes z = const, from front to back, and the media between them: 0 glass, 1 whisky, 2 ice.
Through throughSlabs(const dvec3& p, const dvec3& d) {
    constexpr double kPlanes[] = {0, -0.2, -0.7, -1.1, -1.6, -1.8}, kIor[] = {1, kGlass, kWhisky, kIce, kWhisky, kGlass, 1};
    constexpr int kMedium[] = {-1, 0, 1, 2, 1, 0, -1};
    Through ray{p, d};
    for (int i = 0; i < 6; ++i) {
        const double t = (kPlanes[i] - ray.p.z) / ray.d.z;
        if (kMedium[i] >= 0) ray.lengths[kMedium[i]] += t;
        ray.p += t * ray.d;
        refract(ray, {0, 0, 1}, kIor[i], kIor[i + 1]);
    }
    return ray;
}

/// How the slabs are modelled: nested boxes; or glass walls and ice that the whisky laps over, so that surfaces are hidden.
std::string nestedSlabs(const TemporaryDir& dir) {
    return box(dir, "glass", {-16, -16, -1.8}, {16, 16, 0}, "glass") + "," +
           box(dir, "whisky", {-15, -15, -1.6}, {15, 15, -0.2}, "whisky") + "," +
           box(dir, "ice", {-14, -14, -1.1}, {14, 14, -0.7}, "ice");
}

std::string lappingSlabs(const TemporaryDir& dir) {
    return box(dir, "front", {-16, -16, -0.2}, {16, 16, 0}, "glass") + "," +
           box(dir, "back", {-16, -16, -1.8}, {16, 16, -1.6}, "glass") + "," +
           box(dir, "whisky", {-15, -15, -1.7}, {15, 15, -0.1}, "whisky") + "," +
           box(dir, "ice", {-14, -14, -1.1}, {14, 14, -0.7}, "ice");
}

}  // namespace

TEST_CASE("slabs of glass and whisky and ice bend and absorb light by the closed form, nested or lapping over each other") {
    // The figures of the derivation that this test's closed form must reproduce.
    const Through upright = throughSlabs({0, 0, 1}, {0, 0, -1}), steep = throughSlabs({0, 0, 1}, {std::sqrt(0.75), 0, -0.5});
    CHECK(upright.transmittance == doctest::Approx(0.916545).epsilon(1e-6));
    CHECK(steep.transmittance == doctest::Approx(0.823383).epsilon(1e-6));
    CHECK(glm::length(steep.lengths - dvec3(0.489898, 1.296945, 0.533114)) < 2e-6);
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 2}, {0, 0, 0}, 110, 48};
    for (const bool lapping : {false, true}) {
        CAPTURE(lapping);
        TemporaryDir dir;
        const LoadedScene scene(gpu, bakeScene(dir, "{" + view.text() + R"(,"lights":[)" + wallLight() + R"(],"materials":{)" +
                                                        media() + R"(,"wall":{"model":"phong","diffuse":0.5}},"objects":[)" +
                                                        (lapping ? lappingSlabs(dir) : nestedSlabs(dir)) + "," + wall() + "]}"));
        // Six bounces reach the wall by one way only. Hidden surfaces must not cost one.
        checkPixels(scene.render(depthLimit(6)), 1e-4,
                    [&](uint32_t x, uint32_t y) { return throughSlabs(view.position, view.direction(x, y)).color(); });
    }
}

namespace {

/// Through balls around the origin of radius 1, .9 and .5, or past the inner ones. Gives the number of interfaces.
int throughBalls(Through& ray) {
    constexpr double kRadius[] = {1, 0.9, 0.5}, kIor[] = {1, kGlass, kWhisky, kIce};
    const auto reach = [&](int ball, double side) {  // distance to where a ball is entered (-1) or left (1)
        const double b = -glm::dot(ray.p, ray.d), h2 = kRadius[ball] * kRadius[ball] - glm::dot(ray.p, ray.p) + b * b;
        return h2 > 0 ? b + side * std::sqrt(h2) : -1.0;
    };
    int interfaces = 0, depth = 0;  // depth: balls that the ray is in
    const auto cross = [&](int ball, double side) {
        const double t = reach(ball, side);
        if (depth > 0) ray.lengths[depth - 1] += t;
        ray.p += t * ray.d;
        const dvec3 n = glm::normalize(ray.p);
        refract(ray, side < 0 ? n : -n, kIor[depth], kIor[side < 0 ? depth + 1 : depth - 1]);
        depth += side < 0 ? 1 : -1;
        ++interfaces;
    };
    while (depth < 3 && reach(depth, -1) > 0 && !ray.total) cross(depth, -1);
    while (depth > 0 && !ray.total) cross(depth - 1, 1);
    return interfaces;
}

/// Largest relative error of the pixels whose way has `interfaces` of them and stays clear of rims.
double ballError(const Picture& picture, const View& view, int interfaces, size_t& compared) {
    double worst = 0;
    for (uint32_t y = 0; y < view.size; ++y)
        for (uint32_t x = 0; x < view.size; ++x) {
            const dvec3 d = view.direction(x, y);
            const double b = glm::length(glm::cross(view.position, d));  // impact parameter; rims at 1, .9, and n r = b inside
            if (b > 0.85 || std::abs(b - 0.5 * kIce) < 0.08) continue;
            Through ray{view.position, d};
            if (throughBalls(ray) != interfaces || ray.total) continue;
            const dvec3 expected = ray.color();
            ++compared;
            for (int k = 0; k < 3; ++k)
                worst = std::max(worst, std::abs(picture.at(x, y)[k] - expected[k]) / std::max(expected[k], 1e-3));
        }
    return worst;
}

double ballError(const GpuContext& gpu, const TemporaryDir& dir, const View& view, const std::string& objects) {
    const LoadedScene scene(
        gpu, bakeScene(dir, "{" + view.text() + R"(,"lights":[)" + wallLight() + R"(],"materials":{)" + media() +
                                R"(,"wall":{"model":"phong","diffuse":0.5}},"objects":[)" + objects + "," + wall() + "]}"));
    size_t compared = 0;
    // As many bounces as the way has interfaces: no other way reaches the wall.
    const double past = ballError(scene.render(depthLimit(4)), view, 4, compared);
    const double worst = std::max(past, ballError(scene.render(depthLimit(6)), view, 6, compared));
    CHECK(compared > size_t{view.size} * view.size / 5);
    return worst;
}

/// An octahedron divided `levels` times, on the unit sphere, with exact normals.
std::string roundMesh(int levels) {
    std::string obj;
    const int n = 1 << levels;
    const auto vertex = [&](double x, double y, double z) {
        const dvec3 p = glm::normalize(dvec3(x, y, z));
        const std::string text = " " + json(p.x) + " " + json(p.y) + " " + json(p.z) + "\n";
        obj += "v" + text + "vn" + text;
    };
    int first = 1;
    for (int face = 0; face < 8; ++face) {
        const double sx = face & 1 ? -1 : 1, sy = face & 2 ? -1 : 1, sz = face & 4 ? -1 : 1;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n - i; ++j) vertex(sx * (n - i - j), sy * i, sz * j);
        const auto at = [&](int i, int j) { return first + i * (n + 1) - i * (i - 1) / 2 + j; };
        const auto triangle = [&](int a, int b, int c) {
            if (sx * sy * sz < 0) std::swap(b, c);
            obj += "f";
            for (const int v : {a, b, c}) obj += " " + std::to_string(v) + "//" + std::to_string(v);
            obj += "\n";
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n - i; ++j) {
                triangle(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j < n - 1) triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
        first += (n + 1) * (n + 2) / 2;
    }
    return obj;
}

}  // namespace

TEST_CASE("concentric balls of glass and whisky and ice bend and absorb light by the closed form, as spheres and as meshes") {
    // b = .3 and b = .7: deviation, lengths, transmittance.
    Through ray{{0.3, 0, 3}, {0, 0, -1}};
    CHECK(throughBalls(ray) == 6);
    CHECK(glm::degrees(std::acos(-ray.d.z)) == doctest::Approx(6.984927).epsilon(1e-6));
    CHECK(glm::length(ray.lengths - dvec3(0.204599, 0.847677, 0.888944)) < 2e-6);
    CHECK(ray.transmittance == doctest::Approx(0.916201).epsilon(1e-6));
    ray = {{0.7, 0, 3}, {0, 0, -1}};
    CHECK(throughBalls(ray) == 4);
    CHECK(glm::degrees(std::acos(-ray.d.z)) == doctest::Approx(25.918576).epsilon(1e-6));
    CHECK(glm::length(ray.lengths - dvec3(0.229747, 1.476588, 0)) < 2e-6);
    CHECK(ray.transmittance == doctest::Approx(0.898168).epsilon(1e-6));
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 3}, {0, 0, 0}, 38, 48};
    const TemporaryDir dir;
    const std::string spheres =
        sphere({0, 0, 0}, 1, "glass") + "," + sphere({0, 0, 0}, 0.9, "whisky") + "," + sphere({0, 0, 0}, 0.5, "ice");
    CHECK(ballError(gpu, dir, view, spheres) < 1e-4);
    double before = 0;
    for (const int levels : {5, 6, 7, 8}) {
        dir.write("ball.obj", roundMesh(levels));
        const std::string meshes =
            R"({"mesh":"ball.obj","material":"glass"},{"mesh":"ball.obj","material":"whisky","scale":0.9},)"
            R"({"mesh":"ball.obj","material":"ice","scale":0.5})";
        const double error = ballError(gpu, dir, view, meshes);
        MESSAGE((8 << 2 * levels), " triangles a ball: largest error ", error);
        if (before > 0) CHECK(error < before / 2.5);
        before = error;
    }
    CHECK(before < 1e-4);
}

namespace {

/// A white room without light but its background: what a material does to a radiance of 1.
std::string underWhite(const View& view, const std::string& materials, const std::string& objects, const std::string& more = "") {
    return "{" + view.text() + R"(,"background":{"color":[1,1,1]})" + more + R"(,"materials":{)" + materials +
           R"(},"objects":[)" + objects + "]}";
}

std::string filled(double ior, const dvec3& color, double distance, double inscatter = 0) {
    return R"({"model":"pbr","roughness":0,"transmission":1,"ior":)" + json(ior) + R"(,"attenuationColor":)" + json(color) +
           R"(,"attenuationDistance":)" + json(distance) + R"(,"inscatter":)" + json(inscatter) + "}";
}

}  // namespace

TEST_CASE("a medium that takes nothing and one that takes all are exact, and what is between follows Beer and Lambert") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 5}, {0, 0, 0}, 30, 24};
    const TemporaryDir dir;
    // An index of 1 bends and mirrors nothing, so that the picture is the transmittance of the way through the box.
    const Picture picture = renderScene(
        gpu, dir, underWhite(view, R"("m":)" + filled(1, {1, 0.25, 0}, 2), box(dir, "b", {-9, -9, -3}, {9, 9, 0}, "m")));
    for (uint32_t i = 0; i < 24 * 24; ++i) {
        CHECK(picture.at(i % 24, i / 24).r == 1.0f);
        CHECK(picture.at(i % 24, i / 24).b == 0.0f);
    }
    checkPixels(picture, 2e-6,
                [&](uint32_t x, uint32_t y) { return dvec3(1, std::pow(0.25, 3 / -view.direction(x, y).z / 2), 0); });
}

TEST_CASE("a medium with a colour of its own adds it by the closed form and never makes more light than there is") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 5}, {0, 0, 0}, 30, 24};
    const TemporaryDir dir;
    const dvec3 color(0.9, 0.3, 1), sigma = -glm::log(color) / 2.0;
    const double w = 0.6;
    const Picture picture =
        renderScene(gpu, dir, underWhite(view, R"("m":)" + filled(1, color, 2, w), box(dir, "b", {-9, -9, -3}, {9, 9, 0}, "m")));
    checkPixels(picture, 1e-6, [&](uint32_t x, uint32_t y) {
        const dvec3 depth = sigma * (3 / -view.direction(x, y).z);
        const dvec3 value = glm::exp(-depth) + w * (1.0 - glm::exp(-2.0 * depth)) / 2.0;
        CHECK(std::max({value.r, value.g, value.b}) <= 1);
        return value;
    });
}

TEST_CASE("a camera inside of volumes sees as one that light reaches from outside") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    // From the ice out to the air, through whisky and glass: the slabs of above from their middle. Another volume elsewhere keeps its own count.
    const dvec3 far(200, 0, 0);
    const std::string nested = nestedSlabs(dir) + "," + box(dir, "other", far - 1.0, far + 1.0, "ice");
    const auto away = [](const dvec3& from, const dvec3& d, const std::vector<std::pair<double, double>>& layers,
                         double outside) {
        Through ray{from, d};  // layers: z of the far side, index of the medium
        for (size_t i = 0; i < layers.size(); ++i) {
            const double t = (layers[i].first - ray.p.z) / ray.d.z;
            const int k = layers[i].second == kGlass ? 0 : layers[i].second == kWhisky ? 1 : 2;
            ray.lengths[k] += t;
            ray.p += t * ray.d;
            refract(ray, {0, 0, 1}, layers[i].second, i + 1 < layers.size() ? layers[i + 1].second : outside);
        }
        return ray;
    };
    struct Place {
        double z;
        std::vector<std::pair<double, double>> layers;
    };
    const Place places[] = {{-0.9, {{-1.1, kIce}, {-1.6, kWhisky}, {-1.8, kGlass}}},
                            {-1.3, {{-1.6, kWhisky}, {-1.8, kGlass}}},
                            {-1.7, {{-1.8, kGlass}}},
                            {-0.1, {{-0.2, kGlass}, {-0.7, kWhisky}, {-1.1, kIce}, {-1.6, kWhisky}, {-1.8, kGlass}}}};
    const View view{{0, 0, 0}, {0, 0, -1}, 40, 16};
    const LoadedScene scene(
        gpu, bakeScene(dir, "{" + view.text() + R"(,"lights":[)" + wallLight() + R"(],"materials":{)" + media() +
                                R"(,"wall":{"model":"phong","diffuse":0.5}},"objects":[)" + nested + "," + wall() + "]}"));
    for (const Place& place : places) {
        CAPTURE(place.z);
        // One baked scene, the camera moved through its surfaces from frame to frame.
        const minirt_camera camera = {{0, 0, place.z}, {0, 0, -10}, {0, 1, 0}, 40, 0, 0};
        minirt_render_desc desc = depthLimit(static_cast<uint32_t>(place.layers.size()));
        desc.camera = &camera;
        checkPixels(scene.render(desc), 1e-4, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
            return away({0, 0, place.z}, view.direction(x, y), place.layers, 1).color();
        });
    }
}

TEST_CASE("a camera inside of a lone volume needs no list and sees what it takes") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0, 0}, {0, 0, -1}, 40, 16};
    const Picture picture = renderScene(
        gpu, dir, underWhite(view, R"("m":)" + filled(1, {0.5, 0.25, 1}, 1), box(dir, "b", {-9, -9, -3}, {9, 9, 3}, "m")));
    checkPixels(picture, 1e-6, [&](uint32_t x, uint32_t y) {
        const double length = 3 / -view.direction(x, y).z;
        return dvec3(std::pow(0.5, length), std::pow(0.25, length), 1);
    });
}

TEST_CASE("equal indices bend and mirror nothing in nested volumes") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0, 2}, {0, 0, 0}, 80, 32};
    const auto scene = [&](const std::string& objects) {
        return "{" + view.text() + R"(,"lights":[)" + wallLight() +
               R"(],"materials":{"wall":{"model":"phong","diffuse":0.5},"glass":)" + glass(1.5) + R"(,"whisky":)" + glass(1.5) +
               R"(,"ice":)" + glass(1.5) + R"(},"objects":[)" + objects + wall() + "]}";
    };
    const LoadedScene alone(gpu, bakeScene(dir, scene(box(dir, "glass", {-16, -16, -1.8}, {16, 16, 0}, "glass") + ",")));
    const Picture expected = alone.render(depthLimit(2));
    const LoadedScene nested(gpu, bakeScene(dir, scene(nestedSlabs(dir) + ",")));
    // Four more boundaries between equal media: each costs a bounce, and bends and mirrors nothing.
    double worst = 0;
    const Picture inside = nested.render(depthLimit(6));
    for (uint32_t i = 0; i < 32 * 32; ++i)
        worst = std::max(
            worst, std::abs(double(inside.at(i % 32, i / 32).r) - expected.at(i % 32, i / 32).r) / expected.at(i % 32, i / 32).r);
    CHECK(worst < 3e-5);
}

TEST_CASE("hidden surfaces cost no bounce and leave the direction alone") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0, 2}, {0, 0, 0}, 80, 32};
    const auto scene = [&](const std::string& hidden) {
        return "{" + view.text() + R"(,"lights":[)" + wallLight() +
               R"(],"materials":{"wall":{"model":"phong","diffuse":0.5},"glass":)" + glass(1.5) + R"(,"hidden":)" +
               filled(1.9, {0.1, 0.2, 0.3}, 0.01) + R"(},"objects":[)" +
               R"({"mesh":"glass.obj","material":"glass","priority":1},)" + hidden + wall() + "]}";
    };
    box(dir, "glass", {-16, -16, -1.8}, {16, 16, 0}, "glass");
    const Picture expected = LoadedScene(gpu, bakeScene(dir, scene(""))).render(depthLimit(2));
    std::string boxes;
    for (int i = 0; i < 3; ++i)
        boxes += box(dir, "hidden" + std::to_string(i), {-15, -15, -0.5 - 0.4 * i}, {15, 15, -0.2 - 0.4 * i}, "hidden") + ",";
    const Picture picture = LoadedScene(gpu, bakeScene(dir, scene(boxes))).render(depthLimit(2));
    double worst = 0;
    for (uint32_t i = 0; i < 32 * 32; ++i)
        worst = std::max(worst, std::abs(double(picture.at(i % 32, i / 32).r) - expected.at(i % 32, i / 32).r));
    CHECK(worst < 1e-5);
    CHECK(picture.stats.secondary_rays > expected.stats.secondary_rays);
}

TEST_CASE("light through a slab onto the floor is tinted by both surfaces and by the way, and opaque shadows stay black") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0.5, 3}, {0, 0, 0}, 60, 32};
    const dvec3 toLight = glm::normalize(dvec3(1, 2, 0.5)), color(0.9, 0.5, 0.2);
    const auto scene = [&](const std::string& shadows) {
        return "{" + view.text().substr(0, view.text().size() - 1) + shadows +
               R"(},"lights":[{"type":"directional","direction":)" + json(-toLight) +
               R"(,"irradiance":[3,3,3]}],"materials":{"slab":)" + filled(1.5, color, 1) +
               R"(,"m":{"model":"phong","diffuse":1}},"objects":[)" + box(dir, "slab", {-60, 2, -60}, {60, 2.5, 60}, "slab") +
               "," + floorOf("m") + "]}";
    };
    // Straight through: the way is 0.5 / cos, and each surface takes what a bent ray would lose.
    const dvec3 share = std::pow(1 - fresnel(toLight.y, 1.5), 2) * glm::pow(color, dvec3(0.5 / toLight.y)) * 3.0 * toLight.y;
    const auto onFloor = [&](const dvec3& value) {
        return [&view, value](uint32_t x, uint32_t y) -> std::optional<dvec3> {
            const dvec3 d = view.direction(x, y);
            return d.y < -0.05 ? std::optional<dvec3>(value) : std::nullopt;
        };
    };
    checkPixels(renderScene(gpu, dir, scene("")), 1e-5, onFloor(share));
    checkPixels(renderScene(gpu, dir, scene(R"(,"shadows":"opaque")")), 1e-5, onFloor(dvec3(0)));
}

TEST_CASE("a thin sheet reflects and passes the sums of all ways between its sides, and bends nothing") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 2}, {0, 0, 0}, 80, 32};
    const std::string sheet = R"({"model":"pbr","roughness":0,"transmission":1,"thin":true})";
    const Picture picture =
        renderScene(gpu, "{" + view.text() + R"(,"lights":[)" + wallLight() +
                             R"(],"materials":{"wall":{"model":"phong","diffuse":0.5},"sheet":)" + sheet + R"(},"objects":[)" +
                             rectangle({-16, -16, 0}, {32, 0, 0}, {0, 32, 0}, "sheet") + "," + wall() + "]}");
    checkPixels(picture, 2e-5, [&](uint32_t x, uint32_t y) {
        const dvec3 d = view.direction(x, y);
        const double f = fresnel(-d.z, 1.5);
        return dvec3((1 - f) / (1 + f) * wallRadiance(view.position + (-6 - view.position.z) / d.z * d));
    });
}

TEST_CASE("a list that is too short for the nest is counted and told to the host") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0, 50}, {0, 0, 0}, 20, 8};
    std::string balls;
    for (int i = 0; i < 20; ++i) balls += (i ? "," : "") + sphere({0, 0, 0}, 10 - 0.45 * i, "m");
    const std::string blob = bakeScene(dir, underWhite(view, R"("m":)" + filled(1.01, {1, 1, 1}, 1), balls)).string();
    minirt_scene* scene = nullptr;
    REQUIRE(minirt_load_file(gpu.get(), blob.c_str(), &scene) == MINIRT_OK);
    minirt_stats stats = {};
    minirt_render_desc desc = {};
    desc.stats = &stats;
    std::vector<float> rgba(8 * 8 * 4);
    CHECK(minirt_render(scene, &desc, rgba.data()) == MINIRT_OK);
    CHECK(stats.volume_overflow > 0);
    for (const float value : rgba) CHECK(std::isfinite(value));
    minirt_unload(scene);
}

TEST_CASE("a camera in as many volumes as a ray can be in overflows nothing") {
    GpuContext gpu;
    if (!gpu) return;
    // Wherever the hierarchy puts them: the first primitive is the other ball's in one of these.
    for (const double x : {-5.0, 5.0}) {
        CAPTURE(x);
        const View view{{x, 0, 0.5}, {x, 0, -1}, 40, 8};
        const std::string balls = sphere({-5, 0, 0}, 1, "m") + "," + sphere({5, 0, 0}, 1, "m") + ",";
        for (const double content : {-5.0, 5.0})
            renderScene(gpu, underWhite(view, R"("d":{"model":"phong"},"m":)" + filled(1.5, {0.5, 0.5, 0.5}, 1),
                                        balls + sphere({content, 0, -0.5}, 0.1, "d")));  // fails where it counts an overflow
    }
}

TEST_CASE("a camera right behind the wall of a tank is in its water however far the ground reaches") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    constexpr double kBehind = 0.002;
    const View view{{0.5 - kBehind, 0, 0}, {0, 0, 0}, 5, 8};
    const double expected = std::pow(0.1, 0.5 - kBehind);
    for (const double reach : {20.0, 1e4, 1e5, 1e6}) {
        CAPTURE(reach);
        const Picture picture = renderScene(
            gpu, dir,
            underWhite(view, R"("lamp":)" + glow(1) + R"(,"ground":{"model":"phong"},"water":)" + filled(1.33, dvec3(0.1), 1),
                       rectangle({-reach, -1, -reach}, {0, 0, 2 * reach}, {2 * reach, 0, 0}, "ground") + "," +
                           box(dir, "lamp", {-0.3, -0.3, -0.3}, {0, 0.3, 0.3}, "lamp") + "," +
                           box(dir, "water", {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, "water")));
        checkPixels(picture, 2e-3, [&](uint32_t, uint32_t) { return dvec3(expected); });
    }
}

TEST_CASE("a checker of thin sheets casts the shadows of its cells") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 1, 3}, {0, 0, 0}, 20, 16};
    const double clear = 1 - 2 * 0.04 / 1.04;  // both sides of a sheet, upright
    const auto scene = [&](const std::string& b) {
        return underWhite(
            view,
            R"("floor":{"model":"phong","diffuse":1},"clear":{"model":"pbr","roughness":0,"transmission":1,"thin":true},)"
            R"("opaque":{"model":"phong"},"checker":{"model":"checker","a":"clear","b":")" +
                b + R"(","scale":100})",
            floorOf("floor") + "," + rectangle({-20, 3, -20}, {0, 0, 40}, {40, 0, 0}, "checker"),
            R"(,"lights":[{"type":"directional","direction":[0,-1,0],"irradiance":[1,1,1]}])");
    };
    checkPixels(renderScene(gpu, scene("clear")), 1e-5, [&](uint32_t, uint32_t) { return dvec3(clear); });
    // A cell ends at x = 0 and at z = 0.
    checkPixels(renderScene(gpu, scene("opaque")), 1e-5, [&](uint32_t x, uint32_t y) {
        const dvec3 d = view.direction(x, y), p = view.position - view.position.y / d.y * d;
        return dvec3((p.x > 0) == (p.z > 0) ? clear : 0.0);
    });
}

TEST_CASE("a hidden surface casts no shadow, whatever its material") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 1, 3}, {0, 0, 0}, 20, 16};
    const std::string phong = R"({"model":"phong","diffuse":0,"refract":1,"ior":1.2})";
    for (const std::string& room : {glass(1.5), phong}) {  // what shadow rays pass, and what they do not
        CAPTURE(room);
        const auto scene = [&](const std::string& hidden) {
            return underWhite(view, R"("floor":{"model":"phong","diffuse":1},"room":)" + room + R"(,"hidden":)" + phong,
                              rectangle({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, "floor") +
                                  R"(,{"mesh":"room.obj","material":"room","priority":1})" + hidden,
                              R"(,"lights":[)" + pointLight({0, 2, 0}, dvec3(4), "inverse-square") + "]");
        };
        box(dir, "room", {-5, -5, -5}, {5, 5, 5}, "room");
        const std::string block = "," + box(dir, "block", {-1, 1, -1}, {1, 1.5, 0.5}, "hidden");
        const Picture expected = renderScene(gpu, dir, scene("")), picture = renderScene(gpu, dir, scene(block));
        checkPixels(picture, 1e-5, [&](uint32_t x, uint32_t y) { return dvec3(expected.at(x, y)); });
        CHECK(renderWithAllEffects(gpu, dir, scene(block)) == picture);
    }
}

TEST_CASE("an opaque material is no sheet, thin or not, in every kernel") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 1, 3}, {0, 0, 0}, 20, 16};
    const auto scene = [&](const std::string& thin) {
        return underWhite(view,
                          R"("m":{"model":"phong","diffuse":0,"reflect":0.5,"refract":0,"fresnel":true,"thin":)" + thin + "}",
                          floorOf("m"));
    };
    const Picture thick = renderScene(gpu, dir, scene("false")), thin = renderScene(gpu, dir, scene("true"));
    CHECK(thin == thick);
    CHECK(renderWithAllEffects(gpu, dir, scene("true")) == thin);
}

TEST_CASE("kernels with every effect draw the same bits as those with what the media call for") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0.4, 0.3, 4}, {0, 0, 0}, 45, 32, {0, 1, 0}, 8};
    const std::string lone = sphere({0, 0, 0}, 1, "m") + "," + box(dir, "brick", {1.2, -1, -1}, {2, 1, 1}, "n");
    const std::string nested = sphere({0, 0, 0}, 1, "m") + "," + box(dir, "brick", {0.2, -0.5, -0.5}, {2, 0.5, 0.5}, "n");
    for (const std::string& objects : {lone, nested})
        for (const double inscatter : {0.0, 0.4})
            for (const std::string nesting : {"ordered", "parity"}) {
                CAPTURE(nesting);
                CAPTURE(inscatter);
                const std::string scene =
                    underWhite(view,
                               R"("m":)" + filled(1.5, {0.9, 0.5, 0.4}, 1, inscatter) + R"(,"n":)" + filled(1.3, {1, 1, 1}, 1) +
                                   R"(,"wall":{"model":"phong","diffuse":0.5})",
                               objects + "," + wall(), R"(,"nesting":")" + nesting + R"(","lights":[)" + wallLight() + "]");
                if (nesting == "parity" && objects == lone)
                    continue;  // two methods for what does not nest differ within rounding
                CHECK(renderWithAllEffects(gpu, dir, scene) == renderScene(gpu, dir, scene));
            }
}

TEST_CASE("a gem at 64 bounces holds no NaN and makes no light") {
    if (!haveShared("scenes/seed/asschercut-mesh.obj")) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    std::filesystem::copy(sharedDir() / "scenes/seed/asschercut-mesh.obj", dir.path() / "gem.obj");
    const View view{{1, 2, 6}, {0, 0, 0}, 40, 40, {0, 1, 0}, 64};
    for (const double ior : {2.417, 1.5, 0.7}) {
        CAPTURE(ior);
        const Picture picture = renderScene(
            gpu, dir,
            underWhite(view, R"("m":)" + glass(ior), R"({"mesh":"gem.obj","material":"m","smooth":false,"scale":1.5})"));
        double most = 0, sum = 0;
        for (uint32_t i = 0; i < 1600; ++i) {
            most = std::max(most, double(picture.at(i % 40, i / 40).g));
            sum += double(picture.at(i % 40, i / 40).g);
        }
        MESSAGE("ior ", ior, ": brightest ", most, ", mean ", sum / 1600);
        CHECK(most <= 1 + 1e-4);
        CHECK(sum / 1600 > 0.9);  // a clear gem in a white room is white but for what the cut-offs drop
    }
}
