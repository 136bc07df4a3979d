// Hard inputs for the path tracers: the right picture, or an error that says what is wrong. NaN in an image: image_load_test. No light at all:
// path_test and wavefront_test.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "error.hpp"
#include "image_text.hpp"
#include "path_scene.hpp"
#include "runtime_hooks.hpp"

using glm::dvec3;
using namespace test;

namespace {

LoadedScene load(const GpuContext& gpu, const TemporaryDir& dir, const std::string& scene) {
    return LoadedScene(gpu, bakeScene(dir, scene));
}

/// Irradiance of a floor at p with normal +Y from a rectangle of radiance 1, by its middles; `pass`: the share that comes through, by the cosine at p.
double irradiance(const dvec3& p, const dvec3& origin, const dvec3& u, const dvec3& v,
                  const std::function<double(double)>& pass) {
    constexpr int kParts = 200;
    const dvec3 normal = glm::cross(u, v);
    double sum = 0;
    for (int i = 0; i < kParts; ++i)
        for (int k = 0; k < kParts; ++k) {
            const dvec3 away = origin + u * ((i + 0.5) / kParts) + v * ((k + 0.5) / kParts) - p;
            const double distance = glm::length(away), cosine = away.y / distance;
            if (cosine > 0) sum += pass(cosine) * cosine * std::max(-glm::dot(normal, away), 0.0) / std::pow(distance, 3);
        }
    return sum / (kParts * kParts);
}

double everything(double) {
    return 1;
}

/// What a bake of the scene complains of.
std::string complaint(const TemporaryDir& dir, const std::string& scene) {
    try {
        bakeScene(dir, scene);
    } catch (const minirtc::Error& error) {
        return error.what();
    }
    return "";
}

const std::string kFloor = R"("materials":{"m":)" + lambert(dvec3(0.5)) + R"(},"objects":[)" + floorOf("m") + "]}";

}  // namespace

TEST_CASE("lamps without area are refused or left out") {
    const TemporaryDir dir;
    const std::string view = pathStart(View{{0, 2, 5}, {0, 0, 0}, 30, 16, {0, 1, 0}, 2});
    CHECK(complaint(dir, view + R"("lights":[)" + rectangleLight({0, 1, 0}, {1, 0, 0}, {2, 0, 0}, dvec3(1)) + "]," + kFloor)
              .find("has no area") != std::string::npos);
    CHECK(complaint(dir, view + R"("lights":[{"type":"sphere","center":[0,1,0],"radius":0,"radiance":[1,1,1]}],)" + kFloor)
              .find("radius") != std::string::npos);
    GpuContext gpu;
    if (!gpu) return;
    const auto lit = [&](const std::string& faces) {
        dir.write("lamp.obj", "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\nv 0 2 0\nv 0 2 0\n" + faces);
        return renderPath(load(gpu, dir,
                               view + R"("materials":{"m":)" + lambert(dvec3(0.5)) + R"(,"glow":)" + glow(3) +
                                   R"(},"objects":[)" + floorOf("m") + R"(,{"mesh":"lamp.obj","material":"glow"}]})"),
                          4);
    };
    const std::string faces = "f 1 2 3\nf 1 3 4\n";
    const Picture whole = lit(faces);
    CHECK(meanOf(whole).y > 0.1);
    CHECK(lit(faces + "f 1 2 2\nf 1 5 6\nf 1 5 3\n") == whole);  // corners in one place, or on one line
}

TEST_CASE("a black panorama is as no background") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    dir.write("black.tga", tga(4, 2, [](int, int) { return Rgba{0, 0, 0, 255}; }));
    const std::string view = pathStart(View{{0, 2, 5}, {0, 0, 0}, 40, 16});
    const std::string lamp = R"("lights":[)" + rectangleLight({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, dvec3(3)) + "],";
    const std::string image = R"("background":{"image":"black.tga"},)";
    const LoadedScene dark = load(gpu, dir, view + image + kFloor);
    for (const uint32_t strategy : {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_LIGHTS, MINIRT_LIGHT_SAMPLING_SURFACES})
        CHECK(meanOf(renderPath(dark, 2, strategy)).y == 0);
    const Picture with = renderPath(load(gpu, dir, view + lamp + image + kFloor), 2);
    CHECK(with == renderPath(load(gpu, dir, view + lamp + kFloor), 2));
    CHECK(meanOf(with).y > 0);
}

TEST_CASE("textures of one texel are constants") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    dir.write("white.tga", tga(1, 1, [](int, int) { return Rgba{255, 255, 255, 255}; }));
    dir.write("flat.tga", tga(1, 1, [](int, int) { return Rgba{128, 128, 255, 255}; }));
    const auto scene = [&](const std::string& material, const std::string& background) {
        return load(
            gpu, dir,
            pathStart(View{{0, 2, 4}, {0, 0, 0}, 40, 16}) + R"("background":{)" + background +
                R"(},"materials":{"m":{"model":"pbr",)" + material +
                R"("metallic":0.5,"roughness":0.4,"emissive":[0.2,0.2,0.2],"alpha":0.8,"alphaMode":"blend"}},"objects":[)" +
                floorOf("m") + "," + rectangle({-1, 0.1, 0}, {2, 0, 0}, {0, 1.5, 0}, "m") + "]}");
    };
    const Picture constants = renderPath(scene("", R"("color":[1,1,1])"), 16);
    const Picture images =
        renderPath(scene(R"("baseColor":"white.tga","metallicRoughnessTexture":"white.tga","emissiveTexture":"white.tga",)",
                         R"("image":"white.tga")"),
                   16);
    const Picture flat = renderPath(scene(R"("normalTexture":"flat.tga",)", R"("image":"white.tga")"), 16);
    for (uint32_t i = 0; i < 256; ++i) {
        const dvec3 expected(constants.at(i % 16, i / 16));
        REQUIRE(glm::length(dvec3(images.at(i % 16, i / 16)) - expected) < 1e-5);
    }
    CHECK(std::abs(meanOf(flat).y / meanOf(constants).y - 1) < 0.01);  // 128 of 255 is not quite the middle
}

TEST_CASE("a texture of 8192 by 8192 texels, or an error where the device has no room for it") {
    constexpr int kSide = 8192;
    std::string file(18, '\0');  // .tga in runs of 128 equal texels: 2 MB
    file[2] = 10, file[13] = file[15] = kSide >> 8, file[16] = 24, file[17] = 0x20;
    for (int y = 0; y < kSide; ++y)
        for (int run = 0; run < kSide / 128; ++run)
            file += {'\xff', '\x28', static_cast<char>(y / 32), static_cast<char>(4 * run)};
    const TemporaryDir dir;
    dir.write("big.tga", file);
    const View view{{0, 1, 0}, {0, 0, 0}, 40, 32, {0, 0, -1}, 0};
    const double half = std::tan(glm::radians(20.0));
    const auto blob = bakeScene(
        dir,
        pathStart(view) +
            R"("background":{"color":[1,1,1]},"materials":{"m":{"model":"pbr","ior":1,"baseColor":"big.tga","textureWrap":"clamp"}},"objects":[)" +
            rectangle({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, "m") + "]}");
    {
        GpuContext small;
        if (!small) return;
        limitTexels(small.get(), kSide * kSide - 1);
        CHECK_THROWS_WITH(LoadedScene(small, blob),
                          doctest::Contains("too many texels of images for this device, which takes 67108863"));
        small.takeMessages();
    }
    GpuContext gpu;
    const auto before = std::chrono::steady_clock::now();
    const Picture picture = renderPath(LoadedScene(gpu, blob), 16, MINIRT_LIGHT_SAMPLING_SURFACES);
    MESSAGE("loaded, uploaded and rendered in ", std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count(),
            " s");
    const auto linear = [](double byte) {
        const double c = byte / 255;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 0; x < 32; ++x) {
            const dvec3 color(picture.at(x, y));
            CAPTURE(x);
            CAPTURE(y);
            // A pixel is 2 runs wide and 256 rows high; its samples lie anywhere in it.
            REQUIRE(color.x >= linear(8 * x) - 1e-3);
            REQUIRE(color.x <= linear(8 * x + 4) + 1e-3);
            REQUIRE(color.y >= linear(8 * y) - 1e-3);
            REQUIRE(color.y <= linear(8 * y + 7) + 1e-3);
            REQUIRE(std::abs(color.z - linear(0x28)) < 1e-4);
        }
}

namespace {

/// A square lamp facing down, of 2 `cells`^2 triangles, whose sizes differ where `warp` is over 1.
std::string finelyCut(int cells, double warp) {
    std::string text;
    const auto place = [&](int i) { return json(2 * std::pow(static_cast<double>(i) / cells, warp) - 1); };
    for (int i = 0; i <= cells; ++i)
        for (int k = 0; k <= cells; ++k) text += "v " + place(i) + " 2 " + place(k) + "\n";
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
            const int a = i * (cells + 1) + k + 1, b = a + cells + 1;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) + "\n";
            text += "f " + std::to_string(a) + " " + std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    return text;
}

}  // namespace

TEST_CASE("a lamp of a hundred thousand triangles gives the light of a rectangle") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 3, 6}, {0, 0, 0}, 30, 16, {0, 1, 0}, 0};
    const LoadedScene whole =
        load(gpu, dir,
             pathStart(view) + R"("lights":[)" + rectangleLight({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, dvec3(3)) + "]," + kFloor);
    for (const double warp : {1.0, 2.0}) {
        CAPTURE(warp);
        dir.write("lamp.obj", finelyCut(224, warp));
        const LoadedScene cut = load(gpu, dir,
                                     pathStart(view) + R"("materials":{"m":)" + lambert(dvec3(0.5)) + R"(,"glow":)" + glow(3) +
                                         R"(},"objects":[)" + floorOf("m") + R"(,{"mesh":"lamp.obj","material":"glow"}]})");
        for (const uint32_t strategy : {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_LIGHTS}) {
            const Estimate one = estimate(whole, 16, strategy), other = estimate(cut, 16, strategy);
            MESSAGE("rectangle ", one.mean.y, " +- ", one.sigma.y, ", ", 2 * 224 * 224, " triangles ", other.mean.y, " +- ",
                    other.sigma.y);
            CHECK(std::abs(one.mean.y - other.mean.y) < 4 * std::hypot(one.sigma.y, other.sigma.y));
            CHECK(other.sigma.y < 3 * one.sigma.y);
            CHECK(one.sigma.y < 0.01 * one.mean.y);
        }
    }
}

TEST_CASE("lamps whose powers differ a million times, and sizes as much, light as their formula says") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    struct Lamp {
        std::string name;
        dvec3 origin, u, v;
        double radiance;
    };
    // Side by side as seen from the origin. The last is a millionth as strong as the first, and a centimetre away.
    const Lamp lamps[] = {{"100 m", {-50, 80, -50}, {100, 0, 0}, {0, 0, 100}, 1e-2},
                          {"1 m", {1, 1, 1}, {1, 0, 0}, {0, 0, 1}, 1},
                          {"1 mm", {-0.6, 0.6, -0.3}, {1e-3, 0, 0}, {0, 0, 1e-3}, 1e6},
                          {"1 cm", {0.01, 0.005, -0.005}, {0.01, 0, 0}, {0, 0, 0.01}, 1}};
    const View view{{-0.05, 0.05, 0}, {0, 0, 0}, 0.1, 8, {0, 1, 0}, 0};
    std::string all;
    double sum = 0;
    const auto check = [&](const std::string& name, const std::string& lights, double expected) {
        const LoadedScene scene = load(gpu, dir, pathStart(view) + R"("lights":[)" + lights + "]," + kFloor);
        const Estimate measured = estimate(scene, 256);
        MESSAGE(name, ": ", measured.mean.y, " +- ", measured.sigma.y, ", by the formula ", expected);
        CHECK(std::abs(measured.mean.y - expected) < 4 * measured.sigma.y + 0.005 * expected);
        CHECK(measured.sigma.y < 0.05 * expected);
    };
    for (const Lamp& lamp : lamps) {
        const std::string light = rectangleLight(lamp.origin, lamp.u, lamp.v, dvec3(lamp.radiance));
        const double expected = 0.5 / kPi * lamp.radiance * irradiance({0, 0, 0}, lamp.origin, lamp.u, lamp.v, everything);
        check(lamp.name, light, expected);
        all += (all.empty() ? "" : ",") + light;
        sum += expected;
    }
    check("all", all, sum);
}

TEST_CASE("a lamp a tenth of a millimetre before a wall lights what it faces") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    constexpr double kGap = 1e-4, kLamp = 0.1;
    // A strip along z over x in [-0.1, 0], seen from its side; the wall is the floor.
    const View view{{0.01, 0.01, 0}, {0.0006, 0, 0}, 0.5, 16, {0, 1, 0}, 0};
    const LoadedScene scene = load(gpu, dir,
                                   pathStart(view) + R"("lights":[)" +
                                       rectangleLight({-kLamp, kGap, -2}, {kLamp, 0, 0}, {0, 0, 4}, dvec3(1)) + "]," + kFloor);
    // Of a strip without end: half of the difference of the sines under which its edges are seen.
    double expected = 0;
    constexpr int kSplit = 16;
    View fine = view;
    fine.size *= kSplit;
    for (uint32_t y = 0; y < fine.size; ++y) {
        const dvec3 d = fine.direction(fine.size / 2, y);
        const double x = view.position.x - view.position.y / d.y * d.x;
        REQUIRE(x > kGap);
        expected += 0.25 * ((x + kLamp) / std::hypot(x + kLamp, kGap) - x / std::hypot(x, kGap)) / fine.size;
    }
    for (const uint32_t strategy : {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_SURFACES}) {
        const Estimate measured = estimate(scene, 1024, strategy);
        MESSAGE("beside the lamp ", measured.mean.y, " +- ", measured.sigma.y, ", by the formula ", expected);
        CHECK(std::abs(measured.mean.y - expected) < 4 * measured.sigma.y + 0.005 * expected);
        CHECK(measured.sigma.y < 0.05 * expected);
    }
}

TEST_CASE("a lamp that shines away from a wall close behind it leaves that dark") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0.01, 0.01, 0}, {0.0006, 0, 0}, 0.5, 16, {0, 1, 0}, 0};
    const LoadedScene scene = load(
        gpu, dir,
        pathStart(view) + R"("lights":[)" + rectangleLight({-0.1, 1e-4, -2}, {0, 0, 4}, {0.1, 0, 0}, dvec3(1)) + "]," + kFloor);
    CHECK(meanOf(renderPath(scene, 16)).y == 0);
}

TEST_CASE("a lamp behind a sheet of thin glass, or one that is there in part, lights by what that lets through") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0.3, 0.3}, {0, 0, 0}, 0.2, 8, {0, 1, 0}, 0};
    const dvec3 origin(-0.5, 2, -0.5), u(1, 0, 0), v(0, 0, 1);
    const struct {
        std::string name;
        const char* material;
        std::function<double(double)> pass;
    } sheets[] = {
        {"glass", R"({"model":"pbr","roughness":0,"transmission":1,"thin":true,"ior":1.5})",
         [](double cosine) {
             const double f = fresnel(cosine, 1.5);
             return 1 - 2 * f / (1 + f);
         }},
        {"alpha 0.3", R"({"model":"pbr","ior":1,"baseColor":[0,0,0],"alphaMode":"blend","alpha":0.3})",
         [](double) { return 0.7; }},
        {"a mask of alpha 0.3", R"({"model":"pbr","ior":1,"baseColor":[0,0,0],"alphaMode":"mask","alpha":0.3})", everything},
        {"a mask of alpha 0.7", R"({"model":"pbr","ior":1,"baseColor":[0,0,0],"alphaMode":"mask","alpha":0.7})",
         [](double) { return 0.0; }}};
    for (const auto& sheet : sheets) {
        const LoadedScene scene =
            load(gpu, dir,
                 pathStart(view) + R"("lights":[)" + rectangleLight(origin, u, v, dvec3(1)) + R"(],"materials":{"m":)" +
                     lambert(dvec3(0.5)) + R"(,"sheet":)" + sheet.material + R"(},"objects":[)" + floorOf("m") + "," +
                     rectangle({-9, 1, 9}, {18, 0, 0}, {0, 0, -18}, "sheet") + "]}");
        const double expected = 0.5 / kPi * irradiance({0, 0, 0}, origin, u, v, sheet.pass);
        for (const uint32_t strategy :
             {MINIRT_LIGHT_SAMPLING_MIS, MINIRT_LIGHT_SAMPLING_LIGHTS, MINIRT_LIGHT_SAMPLING_SURFACES}) {
            const Estimate measured = estimate(scene, 64, strategy);
            MESSAGE(sheet.name, ": ", measured.mean.y, " +- ", measured.sigma.y, ", by the formula ", expected);
            CHECK(std::abs(measured.mean.y - expected) <= 4 * measured.sigma.y + 1e-3 * expected);
            CHECK(measured.sigma.y <= 0.03 * expected);
        }
    }
}

TEST_CASE("the limit of what a sample adds is off by default and only darkens") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 2, 4}, {0, 0.5, 0}, 40, 24, {0, 1, 0}, 4};
    const LoadedScene scene = load(
        gpu, dir,
        pathStart(view) + R"("lights":[)" + rectangleLight({-0.1, 0.3, 0}, {0.2, 0, 0}, {0, 0, 0.2}, dvec3(50)) + "]," + kFloor);
    const auto limited = [&](float limit, uint32_t sample) {
        minirt_render_desc desc = {};
        desc.samples = 1;
        desc.first_sample = sample;
        desc.clamp = limit;
        return scene.render(desc);
    };
    constexpr float kLimit = 0.4f;
    size_t darker = 0;
    for (uint32_t sample = 0; sample < 4; ++sample) {
        const Picture plain = limited(0, sample), clamped = limited(kLimit, sample);
        CHECK(limited(1e30f, sample) == plain);
        for (uint32_t y = 0; y < view.size; ++y)
            for (uint32_t x = 0; x < view.size; ++x) {
                const glm::vec3 a = plain.at(x, y), b = clamped.at(x, y);
                const float brightest = std::max({a.x, a.y, a.z});
                darker += brightest > kLimit;
                REQUIRE(glm::length(b - (brightest > kLimit ? a * (kLimit / brightest) : a)) < 1e-6f);
            }
    }
    CHECK(darker > 10);
}

TEST_CASE("a scene a hundred kilometres away looks as it does at the origin") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    dir.write("sky.tga", tga(8, 4, [](int x, int y) {
                  return Rgba{static_cast<unsigned char>(30 * x), 90, static_cast<unsigned char>(60 * y), 255};
              }));
    const auto picture = [&](const dvec3& by) {
        const View view{dvec3(0, 1.5, 4) + by, dvec3(0, 0.6, 0) + by, 40, 32, {0, 1, 0}, 4};
        const std::string wedge = R"({"mesh":"wedge.obj","material":"glass"})";
        std::string obj;
        for (const dvec3& p : {dvec3(-1.5, 0.2, 0), dvec3(-0.5, 0.2, 0), dvec3(-1, 0.2, -0.8), dvec3(-1, 1.2, -0.3)}) {
            const dvec3 at = p + by;
            obj += "v " + json(at.x) + " " + json(at.y) + " " + json(at.z) + "\n";
        }
        dir.write("wedge.obj", obj + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
        const LoadedScene scene = load(
            gpu, dir,
            pathStart(view) + R"("background":{"image":"sky.tga"},"lights":[)" +
                rectangleLight(dvec3(-1, 3, -1) + by, {2, 0, 0}, {0, 0, 2}, dvec3(3)) + "," +
                pointLight(dvec3(2, 2, 2) + by, {3, 3, 3}, "inverse-square") + R"(],"materials":{"m":)" + lambert(dvec3(0.5)) +
                R"(,"gold":{"model":"pbr","metallic":1,"roughness":0.2,"baseColor":[1,0.8,0.3]},"glass":)" + glass(1.5) +
                R"(},"objects":[)" + rectangle(dvec3(-5, 0, 5) + by, {10, 0, 0}, {0, 0, -10}, "m") + "," +
                sphere(dvec3(0.8, 0.6, 0) + by, 0.6, "gold") + "," + wedge + "]}");
        return renderPath(scene, 16);
    };
    const Picture here = picture({0, 0, 0}), there = picture({1e5, -1e5, 1e5});
    double sum = 0;
    uint32_t different = 0;
    for (uint32_t i = 0; i < 32 * 32; ++i) {
        const dvec3 a(here.at(i % 32, i / 32)), b(there.at(i % 32, i / 32));
        const double error = glm::length(a - b) / std::max(glm::length(a), 0.01);
        sum += error;
        different += error > 0.01;
    }
    MESSAGE("mean difference ", sum / 1024, ", pixels off by over 1 %: ", different, " of 1024");
    CHECK(std::abs(meanOf(there).y / meanOf(here).y - 1) < 0.002);
    CHECK(different < 20);
}
