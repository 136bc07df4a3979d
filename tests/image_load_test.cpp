#include <doctest/doctest.h>
#include <tinyexr.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "image_text.hpp"
#include "scene.hpp"
#include "support.hpp"

using namespace minirtc;

// tinyexr 1.0.1 loses the planes of an image that ends early, and gives nobody a pointer to free them by.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libtinyexr";
}

namespace {

/// An uncompressed 32-bit .tga of these texels, row by row.
std::string tga(int width, int height, const std::vector<test::Rgba>& texels) {
    return test::tga(width, height, [&](int x, int y) { return texels[static_cast<size_t>(y * width + x)]; });
}

/// A flat (not run-length coded) .hdr of one row.
std::string hdr(const std::vector<std::array<unsigned char, 4>>& rgbe) {
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X " + std::to_string(rgbe.size()) + "\n";
    for (const auto& c : rgbe) bytes.append(reinterpret_cast<const char*>(c.data()), 4);
    return bytes;
}

std::filesystem::path writeExr(const test::TemporaryDir& dir, const std::vector<float>& rgba, int width, int height) {
    const std::filesystem::path path = dir.path() / "i.exr";
    const char* message = nullptr;
    REQUIRE(SaveEXR(rgba.data(), width, height, 4, 0, path.string().c_str(), &message) == TINYEXR_SUCCESS);
    return path;
}

std::string error(const std::filesystem::path& path) {
    try {
        loadImage(path, ColorSpace::srgb);
    } catch (const Error& e) {
        return std::string(e.what()).substr(path.parent_path().string().size() + 1);
    }
    return "";
}

/// IEC 61966-2-1, the other way round: encodes.
double encodeSrgb(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("every byte value is decoded exactly from sRGB and linearly") {
    test::TemporaryDir dir;
    std::vector<std::array<unsigned char, 4>> ramp;
    for (int i = 0; i < 256; ++i) ramp.push_back({static_cast<unsigned char>(i), 0, 255, static_cast<unsigned char>(i)});
    const auto path = dir.write("ramp.tga", tga(256, 1, ramp));
    const Image srgb = loadImage(path, ColorSpace::srgb), linear = loadImage(path, ColorSpace::linear);
    REQUIRE(srgb.width == 256);
    REQUIRE(srgb.height == 1);
    CHECK(srgb.name == path.string());
    for (int i = 0; i < 256; ++i) {
        CHECK(encodeSrgb(srgb.texels[i].r) * 255 == doctest::Approx(i).epsilon(1e-5));
        CHECK(srgb.texels[i].g == 0);
        CHECK(srgb.texels[i].b == 1);
        CHECK(srgb.texels[i].a == doctest::Approx(i / 255.0));
        CHECK(linear.texels[i].r == doctest::Approx(i / 255.0));
    }
}

TEST_CASE("row 0 is at the top") {
    test::TemporaryDir dir;
    const Image image = loadImage(dir.write("i.tga", tga(1, 2, {{255, 0, 0, 255}, {0, 255, 0, 255}})), ColorSpace::srgb);
    CHECK(image.texels[0] == glm::vec4(1, 0, 0, 1));
    CHECK(image.texels[1] == glm::vec4(0, 1, 0, 1));
    const Image exr = loadImage(writeExr(dir, {1, 0, 0, 1, 0, 1, 0, 1}, 1, 2), ColorSpace::srgb);
    CHECK(exr.texels[0] == glm::vec4(1, 0, 0, 1));
}

TEST_CASE("radiance files are linear") {
    test::TemporaryDir dir;
    const Image image = loadImage(dir.write("i.hdr", hdr({{128, 64, 0, 129}, {128, 128, 128, 139}})), ColorSpace::srgb);
    REQUIRE(image.texels.size() == 2);
    CHECK(image.texels[0] == glm::vec4(1, 0.5f, 0, 1));
    CHECK(image.texels[1] == glm::vec4(1024, 1024, 1024, 1));
    const Image exr = loadImage(writeExr(dir, {1.5f, 0.1f, 20000, 1}, 1, 1), ColorSpace::srgb);
    CHECK(exr.texels[0] == glm::vec4(1.5f, 0.1f, 20000, 1));
}

TEST_CASE("bad images are named with the reason") {
    test::TemporaryDir dir;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    CHECK(error(dir.path() / "none.png") == "none.png: the image cannot be opened; check that it exists and may be read");
    CHECK(error(dir.write("empty.png", "")) == "empty.png: the image is empty or a folder; check the path");
    CHECK(error(dir.write("text.png", "no image at all, just words")) ==
          "text.png: the image cannot be read (unknown image type); give a .jpg, .png, .bmp, .tga, .hdr or .exr file");
    CHECK(error(dir.write("large.tga", test::tga(16385, 1, [](int, int) { return test::Rgba{}; }))) ==
          "large.tga: the image has 16385 x 1 texels; scale it to at most 16384 on a side");
    CHECK(error(writeExr(dir, {1, 1, 1, 1, 1, nan, 1, 1}, 2, 1)) ==
          "i.exr: the texel in column 1 of row 0 is NaN; repair the image; radiance is finite and not negative");
    CHECK(error(writeExr(dir, {1, 1, 1, 1, inf, 1, 1, 1}, 1, 2)) ==
          "i.exr: the texel in column 0 of row 1 is infinite; repair the image; radiance is finite and not negative");
    CHECK(error(writeExr(dir, {1, 1, -1, 1}, 1, 1)) ==
          "i.exr: the texel in column 0 of row 0 is negative; repair the image; radiance is finite and not negative");
}

TEST_CASE("every prefix of an image loads or is refused") {
    test::TemporaryDir dir;
    std::ifstream exr(writeExr(dir, std::vector<float>(8 * 8 * 4, 0.5f), 8, 8), std::ios::binary);
    const std::string exrBytes(std::istreambuf_iterator<char>(exr), {});
    for (const std::string& bytes :
         {tga(3, 1, {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}}), hdr({{128, 64, 0, 129}, {1, 2, 3, 4}}), exrBytes}) {
        for (size_t length = 0; length < bytes.size(); ++length) {
            const std::string message = error(dir.write("part", bytes.substr(0, length)));
            CHECK(message.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("a scene holds each image once in each space it is read as") {
    test::TemporaryDir dir;
    const auto path = dir.write("i.tga", tga(1, 1, {{255, 0, 0, 255}}));
    Scene scene;
    CHECK(addImage(scene, path, ColorSpace::srgb) == 0);
    CHECK(addImage(scene, dir.path() / "." / "i.tga", ColorSpace::srgb) == 0);
    CHECK(addImage(scene, dir.write("j.tga", tga(1, 1, {{128, 0, 0, 255}})), ColorSpace::srgb) == 1);
    CHECK(addImage(scene, dir.path() / "j.tga", ColorSpace::linear) == 2);
    CHECK(addImage(scene, dir.path() / "j.tga", ColorSpace::linear) == 2);
    CHECK(scene.images[1].texels[0].r < 0.3f);
    CHECK(scene.images[2].texels[0].r == 128 / 255.0f);
    const auto floats = writeExr(dir, {1, 0, 0, 1}, 1, 1);
    CHECK(addImage(scene, floats, ColorSpace::srgb) == 3);
    CHECK(addImage(scene, floats, ColorSpace::linear) == 3);  // floats are linear anyway
    CHECK(scene.images.size() == 4);
}

TEST_CASE("the panoramas load") {
    if (!test::haveShared("scenes/real/env")) return;
    for (const char* name : {"forest.hdr", "std_env.hdr", "venice.hdr"}) {
        const Image image = loadImage(test::sharedDir() / "scenes/real/env" / name, ColorSpace::srgb);
        CHECK(image.width == 2 * image.height);
    }
}
