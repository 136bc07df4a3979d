#include <tinyexr.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

#include "scene.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace minirtc {
namespace {

constexpr int kMaxSide = 16384;

using Bytes = std::vector<unsigned char>;

struct Free {
    void operator()(void* p) const { std::free(p); }
};
template <typename T>
using Malloced = std::unique_ptr<T, Free>;

Bytes readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error({path.string()}, "the image cannot be opened", "check that it exists and may be read");
    Bytes bytes;
    char block[1 << 16];
    while (file.read(block, sizeof block) || file.gcount() > 0) bytes.insert(bytes.end(), block, block + file.gcount());
    constexpr size_t kLargest = size_t{1} << 31;  // the decoders count in int
    if (bytes.size() >= kLargest) throw Error({path.string()}, "the image file is over 2 GiB", "make it smaller");
    return bytes;
}

[[noreturn]] void failUndecodable(const std::filesystem::path& path, const std::string& reason) {
    throw Error({path.string()}, "the image cannot be read (" + reason + ")", "give a .jpg, .png, .bmp, .tga, .hdr or .exr file");
}

void requireSize(const std::filesystem::path& path, int64_t width, int64_t height) {
    if (width >= 1 && height >= 1 && width <= kMaxSide && height <= kMaxSide) return;
    throw Error({path.string()}, "the image has " + std::to_string(width) + " x " + std::to_string(height) + " texels",
                "scale it to at most " + std::to_string(kMaxSide) + " on a side");
}

/// IEC 61966-2-1 decoding of all byte values.
std::array<float, 256> srgbTable() {
    std::array<float, 256> table;
    for (int i = 0; i < 256; ++i) {
        const double c = i / 255.0;
        table[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

Image makeImage(int width, int height) {
    Image image;
    image.width = static_cast<uint32_t>(width), image.height = static_cast<uint32_t>(height);
    image.texels.resize(static_cast<size_t>(width) * height);
    return image;
}

Image fromFloats(const float* rgba, int width, int height) {
    Image image = makeImage(width, height);
    std::memcpy(image.texels.data(), rgba, image.texels.size() * sizeof(glm::vec4));
    return image;
}

Image fromBytes(const unsigned char* rgba, int width, int height, ColorSpace space) {
    static const std::array<float, 256> srgb = srgbTable();
    const auto decode = [&](unsigned char c) { return space == ColorSpace::srgb ? srgb[c] : c / 255.0f; };
    Image image = makeImage(width, height);
    for (size_t i = 0; i < image.texels.size(); ++i, rgba += 4)
        image.texels[i] = {decode(rgba[0]), decode(rgba[1]), decode(rgba[2]), rgba[3] / 255.0f};
    return image;
}

Image decodeExr(const std::filesystem::path& path, const Bytes& bytes) {
    EXRVersion version;
    EXRHeader header;
    InitEXRHeader(&header);
    const char* message = nullptr;
    int code = ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size());
    if (code == TINYEXR_SUCCESS) code = ParseEXRHeaderFromMemory(&header, &version, bytes.data(), bytes.size(), &message);
    const auto fail = [&] {
        const std::string reason = message ? message : "damaged EXR file";
        FreeEXRErrorMessage(message);
        failUndecodable(path, reason.substr(0, reason.find('\n')));
    };
    if (code != TINYEXR_SUCCESS) fail();
    const EXRBox2i window = header.data_window;
    FreeEXRHeader(&header);
    requireSize(path, int64_t{window.max_x} - window.min_x + 1, int64_t{window.max_y} - window.min_y + 1);

    float* rgba = nullptr;
    int width = 0, height = 0;
    if (LoadEXRFromMemory(&rgba, &width, &height, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS) fail();
    const Malloced<float> owner(rgba);
    return fromFloats(rgba, width, height);
}

Image decode(const std::filesystem::path& path, const Bytes& bytes, ColorSpace space) {
    static const unsigned char kExrMagic[] = {0x76, 0x2f, 0x31, 0x01};
    if (bytes.size() > sizeof kExrMagic && std::memcmp(bytes.data(), kExrMagic, sizeof kExrMagic) == 0)
        return decodeExr(path, bytes);
    const int length = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), length, &width, &height, &channels)) failUndecodable(path, stbi_failure_reason());
    requireSize(path, width, height);
    if (stbi_is_hdr_from_memory(bytes.data(), length)) {
        const Malloced<float> rgba(stbi_loadf_from_memory(bytes.data(), length, &width, &height, &channels, 4));
        if (!rgba) failUndecodable(path, stbi_failure_reason());
        return fromFloats(rgba.get(), width, height);
    }
    const Malloced<unsigned char> rgba(stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4));
    if (!rgba) failUndecodable(path, stbi_failure_reason());
    return fromBytes(rgba.get(), width, height, space);
}

void rejectImpossibleRadiance(const std::filesystem::path& path, const Image& image) {
    for (size_t i = 0; i < image.texels.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            const float value = image.texels[i][c];
            if (std::isfinite(value) && value >= 0) continue;
            const std::string what = std::isnan(value) ? "NaN" : std::isinf(value) ? "infinite" : "negative";
            throw Error({path.string()},
                        "the texel in column " + std::to_string(i % image.width) + " of row " + std::to_string(i / image.width) +
                            " is " + what,
                        "repair the image; radiance is finite and not negative");
        }
    }
}

}  // namespace

Image loadImage(const std::filesystem::path& path, ColorSpace space) {
    const Bytes bytes = readBytes(path);
    if (bytes.empty()) throw Error({path.string()}, "the image is empty or a folder", "check the path");
    Image image = decode(path, bytes, space);
    rejectImpossibleRadiance(path, image);
    image.name = path.string();
    return image;
}

uint32_t addImage(Scene& scene, const std::filesystem::path& path) {
    const std::filesystem::path normal = path.lexically_normal();
    for (uint32_t i = 0; i < scene.images.size(); ++i)
        if (scene.images[i].name == normal.string()) return i;
    scene.images.push_back(loadImage(normal, ColorSpace::srgb));
    return static_cast<uint32_t>(scene.images.size() - 1);
}

}  // namespace minirtc
