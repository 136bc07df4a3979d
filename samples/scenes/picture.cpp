#include "picture.hpp"

#include <algorithm>
#include <cmath>

#include "output.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace samples {
namespace {

unsigned char linear8(float value) {
    return static_cast<unsigned char>(std::lround(255 * std::clamp(static_cast<double>(value), 0.0, 1.0)));
}

unsigned char srgb8(float linear) {
    const double c = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    return static_cast<unsigned char>(std::lround(255 * encoded));
}

void writePng(const Picture& picture, const std::filesystem::path& path, unsigned char (*encode)(float)) {
    std::vector<unsigned char> bytes;
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const glm::vec3& pixel = picture.pixels[i];
        bytes.insert(bytes.end(), {encode(pixel.r), encode(pixel.g), encode(pixel.b)});
        if (!picture.alpha.empty()) bytes.push_back(linear8(picture.alpha[i]));
    }
    const int channels = picture.alpha.empty() ? 3 : 4;
    if (stbi_write_png(path.string().c_str(), picture.width, picture.height, channels, bytes.data(), channels * picture.width) ==
        0)
        throwCannotWrite(path);
}

}  // namespace

Picture paint(int width, int height, const std::function<glm::dvec3(double, double)>& colorAt) {
    Picture picture{width, height, {}, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) picture.pixels.push_back(glm::vec3(colorAt((x + 0.5) / width, (y + 0.5) / height)));
    }
    return picture;
}

void writeHdr(const Picture& picture, const std::filesystem::path& path) {
    if (stbi_write_hdr(path.string().c_str(), picture.width, picture.height, 3, &picture.pixels[0].x) == 0)
        throwCannotWrite(path);
}

void writePng(const Picture& picture, const std::filesystem::path& path) {
    writePng(picture, path, srgb8);
}

void writeLinearPng(const Picture& picture, const std::filesystem::path& path) {
    writePng(picture, path, linear8);
}

}  // namespace samples
