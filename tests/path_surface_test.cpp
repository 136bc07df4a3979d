// What path tracers make of maps, lenses, filters, nested and dispersing media: closed forms, and Whitted's pictures of what only bends light.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "blob_file.hpp"
#include "image_text.hpp"
#include "path_scene.hpp"

using glm::dvec3;
using namespace test;

namespace {

/// The square from -1 to 1 in the plane z = 0, seen from +z; its texture upright, or turned over left to right.
std::string square(bool mirrored) {
    return std::string("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n") +
           (mirrored ? "vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\n" : "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n") +
           "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
}

std::string onSquare(const std::string& material) {
    return only(material, R"({"mesh":"square.obj","material":"m"})");
}

std::string uniform(const Rgba& texel) {
    return tga(2, 2, [&](int, int) { return texel; });
}

double srgb(int value) {
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// So narrow that all its pixels show about one point.
View at(const dvec3& position, const dvec3& target, uint32_t maxDepth = 2) {
    return View{position, target, 1e-3, 2, {0, 1, 0}, maxDepth};
}

/// Relative to what is expected, or to `least` where that is more.
void checkMean(const Picture& picture, const dvec3& expected, double tolerance, double least = 1e-3) {
    const dvec3 mean = meanOf(picture);
    CAPTURE(mean.x);
    CAPTURE(expected.x);
    for (int k = 0; k < 3; ++k) CHECK(std::abs(mean[k] - expected[k]) <= tolerance * std::max(expected[k], least));
}

constexpr double kHalfFloat = 0x1p-11;  // rounding of a texel

}  // namespace

TEST_CASE("a map of normals tilts them along the image's axes, by its strength, for both kinds of integrator") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const Rgba texel = {200, 90, 210, 255};
    dir.write("normals.tga", uniform(texel));
    const dvec3 stored = dvec3(texel[0], texel[1], texel[2]) / 255.0 * 2.0 - 1.0;
    for (const bool mirrored : {false, true})
        for (const double strength : {1.0, 0.4})
            for (const dvec3& towards : {dvec3(0.8, 0.1, 0.6), dvec3(-0.1, 0.9, 0.5), dvec3(0.3, -0.6, 0.4)}) {
                dir.write("square.obj", square(mirrored));
                const dvec3 n = glm::normalize(stored * dvec3(mirrored ? -strength : strength, strength, 1));
                const dvec3 light = glm::normalize(towards);
                const std::string rest =
                    R"("lights":[{"type":"directional","direction":)" + json(-light) + R"(,"irradiance":[2,2,2]}],)" +
                    onSquare(pbr(R"("ior":1,"baseColor":[0.5,0.5,0.5],"normalTexture":"normals.tga","normalScale":)" +
                                 json(strength)));
                const View view = at({0.3, 0.2, 4}, {0.3, 0.2, 0});
                const dvec3 expected(0.5 / kPi * 2 * std::max(glm::dot(n, light), 0.0));
                CAPTURE(mirrored);
                CAPTURE(strength);
                checkMean(renderScene(gpu, dir, pathScene(view, rest)), expected, 2 * kHalfFloat, 0.5 / kPi * 2);
                checkMean(renderScene(gpu, dir, "{" + view.text() + "," + rest + "}"), expected, 2 * kHalfFloat, 0.5 / kPi * 2);
            }
}

TEST_CASE("a map's green is roughness and its blue is metallic, times the material's") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    dir.write("square.obj", square(false));
    dir.write("worn.tga", uniform({13, 128, 51, 255}));
    const View view{{0.4, -0.5, 2}, {0, 0, 0}, 30, 8, {0, 1, 0}, 1};
    const auto picture = [&](const std::string& finish) {
        return renderScene(gpu, dir,
                           pathScene(view, R"("lights":[)" + pointLight({-0.3, 0.6, 1.5}, {5, 5, 5}, "inverse-square") + "]," +
                                               onSquare(pbr(R"("baseColor":[0.9,0.5,0.2],)" + finish))));
    };
    const Picture mapped = picture(R"("metallicRoughnessTexture":"worn.tga","roughness":0.8,"metallic":0.5)");
    const Picture plain = picture(R"("roughness":)" + json(0.8 * 128 / 255) + R"(,"metallic":)" + json(0.5 * 51 / 255));
    checkPixels(mapped, 16 * kHalfFloat, [&](uint32_t x, uint32_t y) { return dvec3(plain.at(x, y)); });
    const Picture swapped = picture(R"("roughness":)" + json(0.8 * 51 / 255) + R"(,"metallic":)" + json(0.5 * 128 / 255));
    CHECK(glm::length(meanOf(swapped) - meanOf(plain)) > 0.05 * glm::length(meanOf(plain)));
}

TEST_CASE("a map of emission is decoded from sRGB, shown upright, and lights the same however it is found") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    const auto texel = [](int x, int y) {
        return Rgba{static_cast<unsigned char>(60 + 190 * x), static_cast<unsigned char>(40 + 200 * y), 128, 255};
    };
    dir.write("square.obj", square(false));
    dir.write("screen.tga", tga(2, 2, texel));
    const std::string screen =
        pbr(R"("baseColor":[0,0,0],"emissive":[2,3,4],"emissiveTexture":"screen.tga","textureWrap":"clamp")");
    for (const int x : {0, 1})
        for (const int y : {0, 1}) {
            const dvec3 p(x - 0.5, 0.5 - y, 0);  // the middle of a texel
            const Rgba c = texel(x, y);
            checkMean(renderScene(gpu, dir, pathScene(at(p + dvec3(0, 0, 3), p), onSquare(screen))),
                      dvec3(2 * srgb(c[0]), 3 * srgb(c[1]), 4 * srgb(c[2])), 4 * kHalfFloat);
        }
    const View view{{0, -1.9, 1}, {0, -2, 0.6}, 40, 4, {0, 0, 1}, 0};
    const LoadedScene lit(
        gpu, bakeScene(dir, pathScene(view, R"("materials":{"screen":)" + screen + R"(,"floor":)" + lambert(dvec3(0.8)) +
                                                R"(},"objects":[{"mesh":"square.obj","material":"screen"},)" +
                                                rectangle({-9, -2, 9}, {18, 0, 0}, {0, 0, -18}, "floor") + "]")));
    const Estimate picked = estimate(lit, 256, MINIRT_LIGHT_SAMPLING_LIGHTS),
                   found = estimate(lit, 256, MINIRT_LIGHT_SAMPLING_SURFACES), both = estimate(lit, 256);
    for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(picked.mean[k] - found.mean[k]) < 4 * std::hypot(picked.sigma[k], found.sigma[k]));
        CHECK(std::abs(both.mean[k] - found.mean[k]) < 4 * std::hypot(both.sigma[k], found.sigma[k]));
        CHECK(found.sigma[k] < 0.02 * found.mean[k]);
    }
}

namespace {

/// A picture of 32 x 1 squares across the edge of a lamp that fills x > 0 in the plane `distance` before the camera.
Picture edgePicture(const GpuContext& gpu, double distance, double vfov, const std::string& camera, const std::string& render) {
    const std::string scene = R"({"camera":{"position":[0,0,0],"target":[0,0,-1],"vfov":)" + json(vfov) + camera +
                              R"(},"render":{"integrator":"path","maxDepth":0,"size":[32,32],"spp":256)" + render +
                              R"(},"lights":[)" + rectangleLight({0, -99, -distance}, {99, 0, 0}, {0, 198, 0}, dvec3(1)) + "]," +
                              only(lambert(dvec3(1)), sphere({0, 0, 50}, 1, "m")) + "}";
    return renderScene(gpu, scene);
}

/// The mean of a column of pixels.
double column(const Picture& picture, uint32_t x) {
    double sum = 0;
    for (uint32_t y = 0; y < picture.height; ++y) sum += picture.at(x, y).x / picture.height;
    return sum;
}

}  // namespace

TEST_CASE("a lens is sharp at its distance and elsewhere spreads an edge as far as its disk") {
    GpuContext gpu;
    if (!gpu) return;
    const double focus = 2, radius = 0.05, vfov = 6;
    const std::string camera = R"(,"aperture":)" + json(2 * radius) + R"(,"focusDistance":)" + json(focus);
    for (const double distance : {1.0, 2.0, 5.0}) {
        CAPTURE(distance);
        const Picture picture = edgePicture(gpu, distance, vfov, camera, "");
        // A ray from the lens at l towards the slope s meets the lamp's plane at s D + l (1 - D / F): how much of the disk is past the edge.
        const double spread = radius * std::abs(1 - distance / focus);
        for (uint32_t x = 0; x < 32; ++x) {
            double expected = 0;
            for (int i = 0; i < 64; ++i) {
                const double s = ((x + (i + 0.5) / 64) / 16 - 1) * std::tan(glm::radians(vfov / 2)) * distance;
                const double h = spread > 0 ? glm::clamp(s / spread, -1.0, 1.0) : (s > 0 ? 1.0 : -1.0);
                expected += (0.5 + (h * std::sqrt(1 - h * h) + std::asin(h)) / kPi) / 64;
            }
            CHECK(std::abs(column(picture, x) - expected) < 0.01);
        }
    }
}

TEST_CASE("filters weigh what lies beside a pixel as they say") {
    GpuContext gpu;
    if (!gpu) return;
    const auto integrate = [](const std::function<double(double)>& density, double to) {
        double sum = 0;
        constexpr int kParts = 4000;
        for (int i = 0; i < kParts; ++i) {
            const double x = -2 + 4 * (i + 0.5) / kParts;
            sum += x < to ? density(x) * 4 / kParts : 0;
        }
        return sum;
    };
    // Along one axis: the Gaussian of sigma 1/2, cut off along a circle of 3/2.
    const auto gaussian = [](double x) {
        double sum = 0;
        for (int i = 0; i < 400; ++i) {
            const double y = -1.5 + 3 * (i + 0.5) / 400;
            sum += x * x + y * y < 2.25 ? std::exp(-2 * (x * x + y * y)) * 3 / 400 : 0;
        }
        return sum * 2 / kPi / (1 - std::exp(-4.5));
    };
    const struct {
        std::string name;
        std::function<double(double)> density;
    } filters[] = {{"box", [](double x) { return std::abs(x) < 0.5 ? 1.0 : 0.0; }},
                   {"tent", [](double x) { return std::max(1 - std::abs(x), 0.0); }},
                   {"gaussian", gaussian}};
    for (const auto& filter : filters) {
        CAPTURE(filter.name);
        const Picture picture = edgePicture(gpu, 3, 20, "", R"(,"filter":")" + filter.name + "\"");
        // The edge is where pixels 15 and 16 meet.
        for (const uint32_t x : {13u, 14u, 15u, 16u, 17u, 18u})
            CHECK(std::abs(column(picture, x) - integrate(filter.density, x - 15.5)) < 0.01);
    }
}

namespace {

/// The blob with every ray followed, however little it adds: by default, Whitted's tracer drops those below 1/512.
std::filesystem::path withoutCutoff(const std::filesystem::path& path) {
    Blob blob = Blob::read(path);
    blob.contents<minirt_scene_desc>("SCENE")->throughput_cutoff = 0;
    blob.seal();
    blob.write(path);
    return path;
}

}  // namespace

TEST_CASE("nested, absorbing and dispersing glass looks as in Whitted's tracer, which follows every ray") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    dir.write("sky.tga", tga(16, 8, [](int x, int y) {
                  return Rgba{static_cast<unsigned char>(30 + 14 * x), static_cast<unsigned char>(250 - 30 * y),
                              static_cast<unsigned char>(90 + 20 * y), 255};
              }));
    const std::string clear = R"("transmission":1,"roughness":0,)";
    const struct {
        std::string name, glass, render;
        dvec3 eye;
    } cases[] = {{"from outside", R"("ior":1.5)", "", {0, 0.5, 4}},
                 {"from within the glass", R"("ior":1.5)", "", {0, 0, 0.97}},
                 {"three channels", R"("ior":1.6,"dispersion":1)", "", {0, 0.5, 4}},
                 {"wavelengths", R"("ior":1.6,"dispersion":1)", R"("dispersionMode":"spectral",)", {0, 0.5, 4}}};
    for (const auto& c : cases) {
        CAPTURE(c.name);
        // Whisky laps into a glass ball, ice into the whisky.
        const std::string rest = R"("background":{"image":"sky.tga"},"materials":{"glass":)" + pbr(clear + c.glass) +
                                 R"(,"whisky":)" + pbr(clear + R"("ior":1.36,"attenuationColor":[0.9,0.5,0.2],"inscatter":0.2)") +
                                 R"(,"ice":)" + pbr(clear + R"("ior":1.31)") + R"(},"objects":[)" +
                                 sphere({0, 0, 0}, 1, "glass") + "," + sphere({0.1, -0.1, 0}, 0.8, "whisky") + "," +
                                 sphere({-0.2, 0.5, 0.1}, 0.35, "ice") + "]";
        const View view{c.eye, {0, 0, -1}, 30, 16, {0, 1, 0}, 8};  // a tree of 2^8 rays a channel at most
        const LoadedScene path(gpu, bakeScene(dir, pathStart(view, c.render) + rest + "}"));
        std::string whitted = "{" + view.text() + "," + rest + "}";
        whitted.insert(whitted.find(R"("render":{)") + 10, c.render);
        const LoadedScene tree(gpu, withoutCutoff(bakeScene(dir, whitted)));
        minirt_render_desc desc = {};
        desc.width = desc.height = 64;
        desc.samples = 4;
        const dvec3 expected = meanOf(tree.render(desc));
        const Estimate measured = estimate(path, 64);
        MESSAGE(c.name, ": ", measured.mean.x, " ", measured.mean.y, " ", measured.mean.z, " +- ", measured.sigma.y,
                ", Whitted's ", expected.x, " ", expected.y, " ", expected.z);
        for (int k = 0; k < 3; ++k) {
            CHECK(std::abs(measured.mean[k] - expected[k]) < 4 * measured.sigma[k] + 0.001 * expected[k]);
            CHECK(measured.sigma[k] < 0.01 * expected[k]);
        }
    }
}
