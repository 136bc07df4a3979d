#include "picture_file.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#include <tinyexr.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace {

std::string ending(const std::string& path) {
    return std::filesystem::path(path).extension().string();
}

void appendBytes(void* context, void* data, int size) {
    auto* out = static_cast<std::vector<uint8_t>*>(context);
    const auto* bytes = static_cast<const uint8_t*>(data);
    out->insert(out->end(), bytes, bytes + size);
}

std::vector<float> rgbOf(const Picture& picture) {
    std::vector<float> rgb;
    rgb.reserve(picture.rgba.size() / 4 * 3);
    for (size_t i = 0; i < picture.rgba.size(); i += 4) rgb.insert(rgb.end(), &picture.rgba[i], &picture.rgba[i] + 3);
    return rgb;
}

std::vector<uint8_t> encodeSrgbPng(const Picture& picture) {
    std::vector<uint8_t> rgb;
    rgb.reserve(picture.rgba.size() / 4 * 3);
    for (size_t i = 0; i < picture.rgba.size(); i += 4)
        for (size_t k = 0; k < 3; ++k) rgb.push_back(srgbByte(picture.rgba[i + k]));
    return pngBytes(picture.width, picture.height, rgb);
}

std::vector<uint8_t> encodeHdr(const Picture& picture) {
    const std::vector<float> rgb = rgbOf(picture);
    std::vector<uint8_t> bytes;
    stbi_write_hdr_to_func(appendBytes, &bytes, static_cast<int>(picture.width), static_cast<int>(picture.height), 3, rgb.data());
    return bytes;
}

/// Portable float map: bottom row first, little endian.
std::vector<uint8_t> encodePfm(const Picture& picture) {
    const std::vector<float> rgb = rgbOf(picture);
    const std::string header = "PF\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
    std::vector<uint8_t> bytes(header.begin(), header.end());
    const size_t row = size_t{picture.width} * 3;
    for (size_t y = picture.height; y-- > 0;) {
        const auto* first = reinterpret_cast<const uint8_t*>(rgb.data() + y * row);
        bytes.insert(bytes.end(), first, first + row * sizeof(float));
    }
    return bytes;
}

std::vector<uint8_t> encodeExr(const Picture& picture, std::string& problem) {
    constexpr int kChannels = 3;
    const char* names[kChannels] = {"B", "G", "R"};  // in the order that the format asks for
    const size_t pixels = size_t{picture.width} * picture.height;
    std::vector<float> planes[kChannels];
    unsigned char* planePointers[kChannels];
    EXRChannelInfo channels[kChannels] = {};
    int types[kChannels];
    for (int c = 0; c < kChannels; ++c) {
        for (size_t i = 0; i < pixels; ++i) planes[c].push_back(picture.rgba[4 * i + static_cast<size_t>(kChannels - 1 - c)]);
        planePointers[c] = reinterpret_cast<unsigned char*>(planes[c].data());
        std::snprintf(channels[c].name, sizeof channels[c].name, "%s", names[c]);
        types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = kChannels;
    header.channels = channels;
    header.pixel_types = types;
    header.requested_pixel_types = types;
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = kChannels;
    image.images = planePointers;
    image.width = static_cast<int>(picture.width);
    image.height = static_cast<int>(picture.height);
    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const size_t size = SaveEXRImageToMemory(&image, &header, &memory, &message);
    if (size == 0) {
        problem = message ? message : "the picture cannot be encoded as EXR";
        FreeEXRErrorMessage(message);
        return {};
    }
    std::vector<uint8_t> bytes(memory, memory + size);
    free(memory);
    return bytes;
}

}  // namespace

std::vector<uint8_t> pngBytes(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb) {
    std::vector<uint8_t> bytes;
    stbi_write_png_to_func(appendBytes, &bytes, static_cast<int>(width), static_cast<int>(height), 3, rgb.data(),
                           static_cast<int>(width) * 3);
    return bytes;
}

std::string writeWhole(const std::string& path, const std::vector<uint8_t>& bytes) {
    std::string temporary = path + ".XXXXXX";
    const int descriptor = mkstemp(temporary.data());
    FILE* file = descriptor >= 0 ? fdopen(descriptor, "wb") : nullptr;
    if (!file) return path + ": cannot be written: " + std::strerror(errno) + "; is its folder there and writable?";
    bool good = fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && fflush(file) == 0 && fsync(descriptor) == 0;
    good = fclose(file) == 0 && good;
    std::error_code error;
    if (good) std::filesystem::permissions(temporary, std::filesystem::perms(0644), error);
    if (good && !error) std::filesystem::rename(temporary, path, error);
    if (good && !error) return "";
    const std::string reason = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(temporary, error);
    return path + ": cannot be written: " + reason;
}

uint8_t srgbByte(float linear) {
    const float x = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<uint8_t>(encoded * 255.0f + 0.5f);
}

bool isPictureName(const std::string& path) {
    const std::string kind = ending(path);
    return kind == ".png" || kind == ".exr" || kind == ".hdr" || kind == ".pfm";
}

std::string writePicture(const std::string& path, const Picture& picture) {
    const std::string kind = ending(path);
    std::string problem;
    std::vector<uint8_t> bytes;
    if (kind == ".png") bytes = encodeSrgbPng(picture);
    if (kind == ".hdr") bytes = encodeHdr(picture);
    if (kind == ".pfm") bytes = encodePfm(picture);
    if (kind == ".exr") bytes = encodeExr(picture, problem);
    if (bytes.empty()) return path + ": " + (problem.empty() ? "unknown kind of picture; use .png, .exr, .hdr or .pfm" : problem);
    return writeWhole(path, bytes);
}

std::string writePng(const std::string& path, uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb) {
    const std::vector<uint8_t> bytes = pngBytes(width, height, rgb);
    return bytes.empty() ? path + ": the picture cannot be encoded as PNG" : writeWhole(path, bytes);
}

std::string whyNotWritable(const std::string& path) {
    if (std::filesystem::is_directory(path)) return path + ": cannot be written: it is a folder; name a file in it";
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (access(folder.empty() ? "." : folder.c_str(), W_OK) == 0) return "";
    return path + ": cannot be written: " + std::strerror(errno) + "; is its folder there and writable?";
}

std::string readPfm(const std::string& path, Picture& picture) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return path + ": cannot be opened; does the file exist?";
    std::string kind;
    double scale = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    file >> kind >> width >> height >> scale;
    file.get();  // the line break before the floats
    constexpr uint32_t kMaxSide = 16384;
    if (!file || kind != "PF" || scale >= 0 || width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
        return path + ": no little-endian colour .pfm; minirt-render writes such files";
    picture.width = width;
    picture.height = height;
    picture.rgba.assign(size_t{width} * height * 4, 1.0f);
    std::vector<float> row(size_t{width} * 3);
    for (size_t y = height; y-- > 0;) {
        if (!file.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size() * sizeof(float))))
            return path + ": ends before its last pixel";
        for (size_t x = 0; x < width; ++x) std::copy_n(&row[3 * x], 3, &picture.rgba[(y * width + x) * 4]);
    }
    return "";
}
