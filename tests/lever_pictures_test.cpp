// What the accuracy levers do to pictures, against closed forms and against scenes that say the same in another way.
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "host_device.hpp"
#include "render_scene.hpp"
#include "runtime_hooks.hpp"
#include "scene_text.hpp"

using glm::dvec3;
using namespace minirtc;
using namespace test;

namespace {

Picture renderWith(const GpuContext& gpu, const TemporaryDir& dir, const std::string& scene, const LeverSettings& levers,
                   minirt_render_desc desc = {}) {
    BakeOptions options;
    options.choices.levers = levers;
    options.onlyDefault = true;
    return LoadedScene(gpu, bakeScene(dir, scene, "lever", options)).render(desc);
}

const View kView{{0, 3, 5}, {0, 0, 0}, 40, 32};

/// A mirror whose reflectance is Fresnel's, under white.
std::string mirrorScene() {
    return "{" + kView.text() + R"(,"background":{"color":[1,1,1]},"materials":{"m":{"model":"phong","diffuse":0,"reflect":1,)" +
           R"("fresnel":true,"ior":1.5}},"objects":[)" + floorOf("m") + "]}";
}

/// A ball and a block of some glass over a floor.
std::string glassScene(const TemporaryDir& dir, const std::string& glass, const std::string& more = "", bool apart = false) {
    const double left = apart ? 0.8 : -0.1;
    return "{" + kView.text() + more + R"(,"background":{"color":[0.5,0.6,0.7]},"lights":[)" +
           pointLight({2, 4, 3}, {20, 20, 20}, "inverse-square") +
           R"(],"materials":{"floor":{"model":"checker","a":"dark","b":"light"},"dark":{"model":"phong","diffuse":0.1},)" +
           R"("light":{"model":"phong","diffuse":0.8},"n":)" + test::glass(1.3) + R"(,"m":)" + glass + R"(},"objects":[)" +
           floorOf("floor") + "," + sphere({-0.4, 0.7, 0}, 0.6, "m") + "," +
           box(dir, "block", {left, 0.2, -0.6}, {1.4, 1.3, 0.6}, "n") + "]}";
}

std::string glassWith(const std::string& keys) {
    return R"({"model":"pbr","roughness":0,"transmission":1,"ior":1.5)" + keys + "}";
}

double schlick(double cosine) {
    return 0.04 + 0.96 * std::pow(1 - cosine, 5);
}

}  // namespace

TEST_CASE("a dielectric mirror reflects by the lever's formula") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const struct {
        std::string setting;
        double (*reflectance)(double);
    } cases[] = {{"none", [](double) { return 0.0; }}, {"schlick", schlick}, {"exact", [](double cosine) {
                                                                                  return fresnel(cosine, 1.5);
                                                                              }}};
    for (const auto& one : cases) {
        CAPTURE(one.setting);
        checkPixels(renderWith(gpu, dir, mirrorScene(), {{"fresnel", one.setting}}), 1e-5,
                    [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
                        const double cosine = -kView.direction(x, y).y;
                        return cosine > 0.1 ? std::optional<dvec3>(one.reflectance(cosine)) : std::nullopt;
                    });
    }
}

TEST_CASE("a lever that is off draws the scene that does not ask for the effect, bit for bit") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const std::string plain = glassScene(dir, glassWith(""));
    const std::string amber = glassScene(dir, glassWith(R"(,"attenuationColor":[0.9,0.5,0.2],"inscatter":0.5)"));
    const std::string flint = glassScene(dir, glassWith(R"(,"dispersion":2)"));
    CHECK(renderWith(gpu, dir, amber, {{"absorption", "off"}}) == renderWith(gpu, dir, plain, {}));
    CHECK_FALSE(renderWith(gpu, dir, amber, {}) == renderWith(gpu, dir, plain, {}));
    CHECK(renderWith(gpu, dir, flint, {{"dispersion", "off"}}) == renderWith(gpu, dir, plain, {}));
    CHECK_FALSE(renderWith(gpu, dir, flint, {}) == renderWith(gpu, dir, plain, {}));
    dir.write("ball.obj",
              "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
              "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
    const auto ball = [](const char* smooth) {
        return "{" + kView.text() + R"(,"lights":[)" + pointLight({2, 4, 3}, {20, 20, 20}, "none") +
               R"(],"materials":{"m":{"model":"phong"}},"objects":[{"mesh":"ball.obj","material":"m","smooth":)" + smooth + "}]}";
    };
    CHECK(renderWith(gpu, dir, ball("true"), {{"normals", "flat"}}) == renderWith(gpu, dir, ball("false"), {}));
    CHECK_FALSE(renderWith(gpu, dir, ball("true"), {}) == renderWith(gpu, dir, ball("false"), {}));
}

TEST_CASE("levers outweigh the scene's own words, which they equal in effect, and options outweigh the scene's levers") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const auto scene = [&](const std::string& more) { return glassScene(dir, glassWith(R"(,"dispersion":2)"), more); };
    const Picture ordered = renderWith(gpu, dir, scene(""), {});
    const Picture parity = renderWith(gpu, dir, scene(R"(,"nesting":"parity")"), {});
    CHECK_FALSE(parity == ordered);
    CHECK(renderWith(gpu, dir, scene(""), {{"nesting", "parity"}}) == parity);
    CHECK(renderWith(gpu, dir, scene(R"(,"nesting":"parity")"), {{"nesting", "ordered"}}) == ordered);
    std::string file = scene("");
    file.replace(file.find(R"("render":{)"), 10, R"("render":{"accuracy":{"nesting":"parity"},)");
    CHECK(renderWith(gpu, dir, file, {}) == parity);
    CHECK(renderWith(gpu, dir, file, {{"nesting", "ordered"}}) == ordered);
}

TEST_CASE("in doubles spheres and triangles are the same within rounding") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const std::string scene = glassScene(dir, R"({"model":"phong","specular":0.4,"shininess":20})", "", true);
    const Picture picture = renderWith(gpu, dir, scene, {{"precision", "double"}});
    const Picture expected = renderWith(gpu, dir, scene, {});
    CHECK_FALSE(picture == expected);
    size_t apart = 0;  // edges and total reflection magnify
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x) apart += glm::length(picture.at(x, y) - expected.at(x, y)) > 1e-3f ? 1 : 0;
    CHECK(apart * 100 <= size_t{picture.width} * picture.height);
}

TEST_CASE("kernels in doubles are refused where the device is not known to have them") {
    const TemporaryDir dir;
    BakeOptions options;
    options.choices.levers = {{"precision", "double"}};
    options.onlyDefault = true;
    const std::string doubles = bakeScene(dir, mirrorScene(), "doubles", options).string();
    const std::string floats = bakeScene(dir, mirrorScene(), "floats", {}).string();
    std::vector<float> pixels(32 * 32 * 4);
    const auto render = [&](minirt_context* context, const std::string& blob) {
        minirt_scene* scene = nullptr;
        REQUIRE(minirt_load_file(context, blob.c_str(), &scene) == MINIRT_OK);
        const minirt_result result = minirt_render(scene, nullptr, pixels.data());
        minirt_unload(scene);
        return result;
    };
    SUBCASE("its own device, as if it had none") {
        GpuContext gpu;
        if (!gpu) return;
        CHECK(render(gpu.get(), doubles) == MINIRT_OK);
        takeFloat64(gpu.get());
        CHECK(render(gpu.get(), doubles) == MINIRT_ERROR_DEVICE_UNSUPPORTED);
        CHECK(std::string(minirt_last_message(gpu.get())).find("precision=float") != std::string::npos);
        gpu.takeMessages();
        CHECK(render(gpu.get(), floats) == MINIRT_OK);
    }
    SUBCASE("a host's device that does not say so") {
        HostDevice host;
        if (!host) return;
        minirt_context_desc desc = {};
        desc.host = host.desc();
        minirt_context* context = nullptr;
        REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
        CHECK(render(context, doubles) == MINIRT_ERROR_DEVICE_UNSUPPORTED);
        CHECK(std::string(minirt_last_message(context)).find("minirt_host_device") != std::string::npos);
        CHECK(render(context, floats) == MINIRT_OK);
        minirt_destroy(context);
    }
}

TEST_CASE("between two half mirrors that shine the cut-off counts the rays") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const View view{{0, 0, 1}, {0, 0, 0}, 1, 8};
    const std::string scene =
        "{" + view.text() +
        R"(,"materials":{"m":{"model":"pbr","metallic":1,"roughness":0,"baseColor":[0.5,0.5,0.5],"emissive":[1,1,1]}},"objects":[)" +
        rectangle({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, "m") + "," + rectangle({-9, -9, 2}, {0, 18, 0}, {18, 0, 0}, "m") + "]}";
    const auto radiance = [&](float cutoff) {
        minirt_render_desc desc = {};
        desc.throughput_cutoff = cutoff;
        return renderWith(gpu, dir, scene, {}, desc).at(4, 4).r;
    };
    CHECK(radiance(0) == 2 - 0x1p-8f);  // 1/512 of the blob
    CHECK(radiance(0.3f) == 1.5f);
    CHECK(radiance(1) == 1);
    CHECK(radiance(-1) == 2 - 0x1p-20f);  // the depth limit
    CHECK_THROWS_AS(radiance(NAN), std::runtime_error);
    gpu.takeMessages();
}
