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
    image.isFloat = true;
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

/// A file being read by tinyexr, whose one-call readers leak where a file is damaged.
struct Exr {
    Exr() { InitEXRHeader(&header), InitEXRImage(&image); }
    ~Exr() { FreeEXRImage(&image), FreeEXRHeader(&header), FreeEXRErrorMessage(message); }
    Exr(const Exr&) = delete;
    Exr& operator=(const Exr&) = delete;

    std::string reason() const {
        const std::string text = message ? message : "damaged EXR file";
        return text.substr(0, text.find('\n'));
    }

    EXRVersion version = {};
    EXRHeader header;
    EXRImage image;
    const char* message = nullptr;
};

/// The channels that give red, green, blue and alpha; -1: alpha is 1. A single channel gives grey.
std::array<int, 4> findChannels(const std::filesystem::path& path, const EXRHeader& header) {
    static const std::string kNames = "RGBA";
    std::array<int, 4> found = {-1, -1, -1, -1};
    for (int c = 0; c < header.num_channels; ++c) {
        const std::string name = header.channels[c].name;
        if (name.size() == 1 && kNames.find(name) != std::string::npos) found[kNames.find(name)] = c;
    }
    if (header.num_channels == 1) found = {0, 0, 0, -1};
    if (found[0] < 0 || found[1] < 0 || found[2] < 0) failUndecodable(path, "it has no channels R, G and B");
    for (int c = 0; c < header.num_channels; ++c)
        if (header.pixel_types[c] == TINYEXR_PIXELTYPE_UINT) failUndecodable(path, "its channels are integers");
    return found;
}

void copyExrBlock(unsigned char** planes, const std::array<int, 4>& channels, int stride, int left, int top, int width,
                  int height, Image& image) {
    for (int y = 0; y < height && top + y < static_cast<int>(image.height); ++y) {
        for (int x = 0; x < width && left + x < static_cast<int>(image.width); ++x) {
            glm::vec4& texel = image.texels[static_cast<size_t>(top + y) * image.width + left + x];
            for (int c = 0; c < 4; ++c)
                texel[c] =
                    channels[c] < 0 ? 1.0f : reinterpret_cast<float**>(planes)[channels[c]][static_cast<size_t>(y) * stride + x];
        }
    }
}

Image decodeExr(const std::filesystem::path& path, const Bytes& bytes) {
    Exr exr;
    if (ParseEXRVersionFromMemory(&exr.version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS ||
        ParseEXRHeaderFromMemory(&exr.header, &exr.version, bytes.data(), bytes.size(), &exr.message) != TINYEXR_SUCCESS)
        failUndecodable(path, exr.reason());
    if (exr.version.multipart || exr.version.non_image)
        failUndecodable(path, "EXR files with several parts or deep pixels are not read");
    const EXRBox2i window = exr.header.data_window;
    requireSize(path, int64_t{window.max_x} - window.min_x + 1, int64_t{window.max_y} - window.min_y + 1);
    const std::array<int, 4> channels = findChannels(path, exr.header);
    for (int c = 0; c < exr.header.num_channels; ++c) exr.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    if (LoadEXRImageFromMemory(&exr.image, &exr.header, bytes.data(), bytes.size(), &exr.message) != TINYEXR_SUCCESS) {
        InitEXRImage(&exr.image);  // after a failure its pointers are to freed memory
        failUndecodable(path, exr.reason());
    }

    Image image = makeImage(exr.image.width, exr.image.height);
    image.isFloat = true;
    if (exr.image.images)
        copyExrBlock(exr.image.images, channels, exr.image.width, 0, 0, exr.image.width, exr.image.height, image);
    for (int i = 0; i < exr.image.num_tiles; ++i) {
        const EXRTile& tile = exr.image.tiles[i];
        if (tile.level_x != 0 || tile.level_y != 0) continue;
        copyExrBlock(tile.images, channels, exr.header.tile_size_x, tile.offset_x * exr.header.tile_size_x,
                     tile.offset_y * exr.header.tile_size_y, tile.width, tile.height, image);
    }
    return image;
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
    image.space = space;
    return image;
}

uint32_t addImage(Scene& scene, const std::filesystem::path& path, ColorSpace space) {
    const std::filesystem::path normal = path.lexically_normal();
    for (uint32_t i = 0; i < scene.images.size(); ++i) {
        const Image& image = scene.images[i];
        if (image.name == normal.string() && (image.isFloat || image.space == space)) return i;
    }
    scene.images.push_back(loadImage(normal, space));
    return static_cast<uint32_t>(scene.images.size() - 1);
}

}  // namespace minirtc
