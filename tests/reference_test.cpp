// Pictures of the path tracer against those that Mitsuba's authors rendered of their own test scenes (docs/references.md).
#include <doctest/doctest.h>
#include <tinyexr.h>

#include <array>
#include <cmath>

#include "commands.hpp"
#include "reference_picture.hpp"
#include "scene.hpp"
#include "scene_text.hpp"

using glm::dvec2;
using glm::dvec3;
using namespace test;

namespace {

const char* const kReferences = "scenes/real/reference";

std::filesystem::path common(const std::string& file) {
    return sharedDir() / kReferences / "common" / file;
}

std::filesystem::path mitsuba(const std::string& file) {
    return sharedDir() / kReferences / "mitsuba" / file;
}

// ---- Mitsuba's conventions ----

/// Its default lens: 50 mm before film of 36 x 24 mm, kept along the diagonal; so the half width of a square picture at distance 1.
const double kHalfWidth = std::hypot(36.0, 24.0) / 100 / std::sqrt(2.0);

/// Looks along +x, +z up.
std::string cameraAndRender(double distance, int size, int maxDepth) {
    return R"("camera":{"position":)" + json(dvec3(-distance, 0, 0)) + R"(,"target":[0,0,0],"up":[0,0,1],"vfov":)" +
           json(2 * glm::degrees(std::atan(kHalfWidth))) + R"(},"render":{"integrator":"path","size":[)" + json(size) + "," +
           json(size) + R"(],"maxDepth":)" + json(maxDepth - 1) + "}";
}

/// The radiance that "400:0, 500:8, 600:15.6, 700:18.4" is in rgb modes: the spectrum under CIE 1931, over 106.7502594, in linear sRGB.
const dvec3 kLampRadiance(20.7108, 10.8546, 2.77116);

/// meshes/rectangle.obj, scaled by 2, turned by 120 degrees about y and moved to (-4, 0, 6), where it shines down on what lies ahead.
std::string lamp(double brightness = 1) {
    const double sine = std::sqrt(0.75);
    return R"({"type":"rectangle","origin":)" + json(dvec3(-3, -2, 6 + 2 * sine)) + R"(,"u":)" + json(dvec3(-2, 0, -4 * sine)) +
           R"(,"v":[0,4,0],"radiance":)" + json(brightness * kLampRadiance) + "}";
}

void writeExr(const std::filesystem::path& path, const std::vector<float>& rgba, int width, int height) {
    const char* message = nullptr;
    REQUIRE(SaveEXR(rgba.data(), width, height, 4, 0, path.string().c_str(), &message) == TINYEXR_SUCCESS);
}

/// Mitsuba's first and last rows of a panorama lie on the poles, ours half a row away from them, and its u is 90 degrees ahead. Eight times
/// the rows make the bilinear interpolation of one that of the other.
void writePanorama(const TemporaryDir& dir) {
    const minirtc::Image image = minirtc::loadImage(common("textures/museum.exr"), minirtc::ColorSpace::linear);
    const uint32_t width = image.width, height = 8 * image.height;
    std::vector<float> rgba;
    for (uint32_t row = 0; row < height; ++row) {
        const double y = (row + 0.5) / height * (image.height - 1);
        const auto above = std::min(static_cast<uint32_t>(y), image.height - 2);
        for (uint32_t column = 0; column < width; ++column) {
            const size_t at = size_t{above} * width + (column + width * 3 / 4) % width;
            const glm::vec4 texel = glm::mix(image.texels[at], image.texels[at + width], static_cast<float>(y - above));
            rgba.insert(rgba.end(), {texel.x, texel.y, texel.z, 1});
        }
    }
    writeExr(dir.path() / "museum.exr", rgba, static_cast<int>(width), static_cast<int>(height));
}

const char* const kPanorama = R"("background":{"image":"museum.exr"})";

std::string lambert(const std::string& color) {
    return R"({"model":"pbr","ior":1,"baseColor":)" + color + "}";
}

std::string textured() {
    return lambert("\"" + common("textures/wood.jpg").string() + "\"");
}

std::string ball(const std::string& material, const dvec3& at) {
    return R"({"mesh":")" + common("meshes/sphere.obj").string() + R"(","material":")" + material + R"(","translate":)" +
           json(at) + "}";
}

// ---- The grid of balls ----

struct Cell {
    const char* what;
    dvec2 at;  // y and z
    const char* material;
};

/// What is not ours stands in the grid as black balls, which cast the same shadows.
const std::array<Cell, 12> kGrid = {{{"diffuse", {-6, 0}, "diffuse"},
                                     {"diffuse textured", {-3, 0}, "wood"},
                                     {"dielectric, diamond", {0, 0}, "diamond"},
                                     {"plastic", {3, 0}, "black"},
                                     {"roughdielectric, Beckmann", {6, 0}, "black"},
                                     {"roughdielectric, GGX", {6, 3}, "frosted"},
                                     {"roughplastic", {3, 3}, "black"},
                                     {"roughplastic, brighter", {0, 3}, "black"},
                                     {"conductor", {-3, 3}, "black"},
                                     {"roughconductor", {-6, 3}, "black"},
                                     {"mask of twosided diffuse", {-6, -3}, "leaf"},
                                     {"mask of diffuse", {-3, -3}, "leaf"}}};

/// The square of a leaf, corners as rectangle.obj has them, under its two transforms.
void writeLeaf(const TemporaryDir& dir, const std::string& name, bool reversed) {
    std::string obj;
    for (const dvec2& p : {dvec2(-1, -1), dvec2(1, -1), dvec2(-1, 1), dvec2(1, 1)})
        obj += "v 0 " + json(reversed ? p.x : -p.x) + " " + json(-p.y) + "\n";
    dir.write(name, obj + "vt 1 1\nvt 0 0\nvt 0 1\nvt 1 0\nf 2/1 3/2 1/3\nf 2/1 4/4 3/2\n");
}

/// Colour of the leaves, with the grey of the mask, decoded from sRGB, as alpha.
void writeMask(const TemporaryDir& dir) {
    const minirtc::Image image = minirtc::loadImage(common("textures/leaf_mask.png"), minirtc::ColorSpace::srgb);
    std::vector<float> rgba;
    for (const glm::vec4& texel : image.texels) rgba.insert(rgba.end(), {0.1f, 0.8f, 0.1f, texel.x});
    writeExr(dir.path() / "leaf.exr", rgba, static_cast<int>(image.width), static_cast<int>(image.height));
}

/// `lighting`: members "background" or "lights". Mitsuba's light sampling takes masked surfaces as whole ones, so the balls are to be seen
/// with whole leaves beside them (`masked` false) and the leaves with their masks.
std::string gridScene(const TemporaryDir& dir, const std::string& lighting, bool masked) {
    writeLeaf(dir, "leaf_away.obj", false);
    writeLeaf(dir, "leaf_here.obj", true);
    writeMask(dir);
    std::string objects;
    for (const Cell& cell : kGrid)
        if (cell.at.y >= 0) objects += ball(cell.material, {0, cell.at.x, cell.at.y}) + ",";
    const std::string vacuum = "1.000277";
    return "{" + cameraAndRender(24, 48, 2) + "," + lighting + R"(,"materials":{"black":)" + lambert("[0,0,0]") +
           R"(,"diffuse":)" + lambert("[0.2,0.5,0.3]") + R"(,"wood":)" + textured() +
           R"(,"diamond":{"model":"pbr","roughness":0,"transmission":1,"ior":)" + json(2.419 / 1.000277) +
           R"(},"frosted":{"model":"pbr","transmission":1,"roughness":)" + json(std::sqrt(0.1)) + R"(,"ior":)" +
           json(1.5046 / 1.000277) + R"(},"leaf":{"model":"pbr","ior":1,"baseColor":)" +
           (masked ? R"("leaf.exr","alphaMode":"blend")" : "[0,0,0]") + R"(}},"objects":[)" + objects +
           R"({"mesh":"leaf_away.obj","material":"leaf","translate":[0,-6,-3]},{"mesh":"leaf_here.obj","material":"leaf","translate":[0,-3,-3]}]})";
}

/// Whether a pixel may show something of the cell.
bool shows(const Cell& cell, uint32_t x, uint32_t y) {
    const double scale = 24 * kHalfWidth / 24;  // metres a pixel in the plane of the balls
    const dvec2 at((24 - (x + 0.5)) * scale, (24 - (y + 0.5)) * scale);
    return std::abs(at.x - cell.at.x) < 1.3 && std::abs(at.y - cell.at.y) < 1.3;
}

/// The pixels that show nothing but what `accepts`, or the background.
Selection showing(const std::function<bool(const Cell&)>& accepts) {
    return [accepts](uint32_t x, uint32_t y) {
        for (const Cell& cell : kGrid)
            if (shows(cell, x, y) && !accepts(cell)) return false;
        return true;
    };
}

constexpr uint32_t kPasses = 32;
constexpr uint32_t kSamples = 32;

void checkGrid(const GpuContext& gpu, const std::string& name, const std::string& lighting, const TemporaryDir& dir) {
    const Reference reference = readReference(mitsuba("bsdf_spheres/refs"), "test_" + name + "_ref_rgb");
    const auto isLeaf = [](const Cell& cell) { return std::string(cell.material) == "leaf"; };
    const LoadedScene whole(gpu, bakeScene(dir, gridScene(dir, lighting, false)));
    const Passes balls = renderPasses(whole, kPasses, kSamples);
    for (const Cell& cell : kGrid) {
        if (isLeaf(cell) || std::string(cell.material) == "black") continue;
        checkAgreement(name + ", " + cell.what, reference, balls, [&](uint32_t x, uint32_t y) { return shows(cell, x, y); });
    }
    checkAgreement(name + ", balls and background", reference, balls,
                   showing([&](const Cell& cell) { return !isLeaf(cell) && std::string(cell.material) != "black"; }));
    const LoadedScene cut(gpu, bakeScene(dir, gridScene(dir, lighting, true)));
    const Passes leaves = renderPasses(cut, kPasses, kSamples);
    for (const Cell& cell : kGrid)
        if (isLeaf(cell))
            checkAgreement(name + ", " + cell.what, reference, leaves, [&](uint32_t x, uint32_t y) { return shows(cell, x, y); });
}

}  // namespace

TEST_CASE("variances of the references are of XYZ, and their test is the one that is used here") {
    if (!haveShared(kReferences)) return;
    // A picture that Mitsuba's own test rejected, with its p-values: what fails is 1 in the picture of errors, all else 0.02 of the picture.
    const std::string name = "infinite_mirrors/scene_render_scalar_rgb";
    const XyzPicture p = readXyz(mitsuba(name + "_pvalue.exr"));
    const XyzPicture picture = readXyz(mitsuba(name + ".exr")), errors = readXyz(mitsuba(name + "_error.exr"));
    const double level = 1 - std::pow(0.99, 1.0 / static_cast<double>(p.pixels.size()));
    size_t rejected = 0;
    for (size_t i = 0; i < p.pixels.size(); ++i) {
        const double least = std::min({p.pixels[i].x, p.pixels[i].y, p.pixels[i].z});
        CHECK(least > -1e-6);
        CHECK(std::max({p.pixels[i].x, p.pixels[i].y, p.pixels[i].z}) < 1 + 1e-6);
        const bool marked = glm::length(errors.pixels[i] - 0.02 * picture.pixels[i]) > 1e-6;
        CHECK(marked == (least < level));
        rejected += marked ? 1 : 0;
    }
    CHECK(rejected == 1);
}

TEST_CASE("balls under a constant environment") {
    if (!haveShared(kReferences)) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    // D65 by Mitsuba's tables, as its background shows it.
    checkGrid(gpu, "constant", R"("background":{"color":[1.00108409,0.99970782,0.99970305]})", dir);
}

TEST_CASE("balls in a museum") {
    if (!haveShared(kReferences)) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    writePanorama(dir);
    checkGrid(gpu, "envmap", kPanorama, dir);
}

TEST_CASE("balls under a lamp") {
    if (!haveShared(kReferences)) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    checkGrid(gpu, "arealight", R"("lights":[)" + lamp() + "]", dir);
}

TEST_CASE("a wooden ball under a lamp, a point light and in a museum") {
    if (!haveShared(kReferences)) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    writePanorama(dir);
    const LoadedScene scene(
        gpu, bakeScene(dir, "{" + cameraAndRender(4, 48, 2) + "," + kPanorama + R"(,"lights":[)" + lamp() + "," +
                                pointLight({-4, 0, -6}, dvec3(300), "inverse-square") + R"(],"materials":{"wood":)" + textured() +
                                R"(},"objects":[)" + ball("wood", dvec3(0)) + "]}"));
    checkAgreement("textured_diffuse", readReference(mitsuba("bsdf_spheres/refs"), "test_textured_diffuse_ref_rgb"),
                   renderPasses(scene, kPasses, kSamples), [](uint32_t, uint32_t) { return true; });
}

TEST_CASE("three mirrors in a museum lie between a brighter and a darker kind of mirror") {
    if (!haveShared(kReferences)) return;
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    writePanorama(dir);
    const Reference reference = readReference(mitsuba("infinite_mirrors/refs"), "scene_ref_rgb");
    // Their metal, of index 0.789 + 6.15 i, reflects 0.923068 along the normal, 0.878070 at least (at 80 degrees), 1 at grazing incidence. Ours,
    // after Schlick, has the first and the last and never reflects less; a phong mirror reflects the same share everywhere.
    const auto render = [&](const std::string& mirror) {
        const LoadedScene scene(gpu, bakeScene(dir, "{" + cameraAndRender(5, 32, 8) + "," + kPanorama + R"(,"materials":{"m":)" +
                                                        mirror + R"(},"objects":[)" + ball("m", {0, -1.05, -0.9}) + "," +
                                                        ball("m", {0, 1.05, -0.9}) + "," + ball("m", {0, 0, 0.9}) + "]}"));
        return renderPasses(scene, kPasses, kSamples);
    };
    const auto metal = [](double f0) {
        return R"({"model":"pbr","metallic":1,"roughness":0,"baseColor":)" + json(dvec3(f0)) + "}";
    };
    checkBetween("infinite_mirrors", reference, render(R"({"model":"phong","diffuse":0,"reflect":0.878070})"),
                 render(metal(0.923068)));
}
