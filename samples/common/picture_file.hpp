// Linear pictures to files.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// `rgba`: width * height * 4 floats, linear radiance, top row first.
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> rgba;
};

/// True for the endings that writePicture knows: .png .exr .hdr .pfm.
bool isPictureName(const std::string& path);

/// .png: sRGB, clamped, 8 bits. .exr (float) and .pfm: the floats bit for bit. .hdr: RGBE. The file appears whole or not at all.
/// Returns "" or what went wrong.
std::string writePicture(const std::string& path, const Picture& picture);

/// Reads a little-endian colour .pfm with alpha 1. Returns "" or what went wrong.
std::string readPfm(const std::string& path, Picture& picture);

/// The sRGB byte of a linear value; NaN is 0.
uint8_t srgbByte(float linear);

/// width * height * 3 bytes, top row first, as they are, as a PNG; empty where there is no memory.
std::vector<uint8_t> pngBytes(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb);

/// Writes width * height * 3 bytes, top row first, as they are. Returns "" or what went wrong.
std::string writePng(const std::string& path, uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb);

/// Writes the file whole or not at all. Returns "" or what went wrong.
std::string writeWhole(const std::string& path, const std::vector<uint8_t>& bytes);

/// Returns "" where a file could be written now, or why not: to be asked before hours of rendering.
std::string whyNotWritable(const std::string& path);
