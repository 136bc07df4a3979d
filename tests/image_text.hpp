// Small image files for scenes of tests.
#pragma once
#include <array>
#include <functional>
#include <string>

namespace test {

using Rgba = std::array<unsigned char, 4>;

/// An uncompressed 32-bit .tga, rows from the top.
inline std::string tga(int width, int height, const std::function<Rgba(int x, int y)>& texel) {
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = static_cast<char>(width & 255), bytes[13] = static_cast<char>(width >> 8);
    bytes[14] = static_cast<char>(height & 255), bytes[15] = static_cast<char>(height >> 8);
    bytes[16] = 32;
    bytes[17] = 0x28;
    bytes.reserve(18 + size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgba c = texel(x, y);
            for (const size_t i : {2u, 1u, 0u, 3u}) bytes += static_cast<char>(c[i]);
        }
    return bytes;
}

}  // namespace test
