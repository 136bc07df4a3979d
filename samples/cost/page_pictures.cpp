#include "page_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "error_metrics.hpp"

namespace cost {
namespace {

std::string pngUri(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb) {
    return "data:image/png;base64," + base64(pngBytes(width, height, rgb));
}

/// Dark to light, for 0..1 by the logarithm of the difference; a dozen colours keep the file small.
std::array<uint8_t, 3> heat(double t) {
    constexpr std::array<std::array<double, 3>, 6> kStops = {
        {{20, 11, 52}, {101, 21, 110}, {188, 55, 84}, {237, 105, 37}, {251, 180, 26}, {252, 255, 200}}};
    constexpr double kColours = 12;
    const double at = std::min(std::floor(t * kColours) / (kColours - 1), 1.0) * (kStops.size() - 1);
    const auto below = std::min(static_cast<size_t>(at), kStops.size() - 2);
    const double part = at - static_cast<double>(below);
    std::array<uint8_t, 3> colour{};
    for (size_t k = 0; k < 3; ++k)
        colour[k] = static_cast<uint8_t>(kStops[below][k] + part * (kStops[below + 1][k] - kStops[below][k]) + 0.5);
    return colour;
}

std::array<uint8_t, 3> colourOf(int steps) {
    if (steps <= kUnseenSteps) return {0, 0, 0};
    constexpr double kMost = 128;
    return heat(std::log(static_cast<double>(steps) / kUnseenSteps) / std::log(kMost / kUnseenSteps));
}

}  // namespace

std::string pictureUri(const Picture& picture) {
    std::vector<uint8_t> rgb;
    rgb.reserve(picture.rgba.size() / 4 * 3);
    for (size_t i = 0; i < picture.rgba.size(); ++i)
        if (i % 4 != 3) rgb.push_back(srgbByte(picture.rgba[i]));
    return pngUri(picture.width, picture.height, rgb);
}

std::string differenceUri(const Picture& picture, const Picture& reference) {
    std::vector<uint8_t> rgb;
    rgb.reserve(picture.rgba.size() / 4 * 3);
    for (size_t p = 0; p < picture.rgba.size(); p += 4) {
        int worst = 0;
        for (size_t i = p; i < p + 3; ++i)
            worst = std::max(worst, std::abs(srgbByte(picture.rgba[i]) - srgbByte(reference.rgba[i])));
        const std::array<uint8_t, 3> colour = colourOf(worst);
        rgb.insert(rgb.end(), colour.begin(), colour.end());
    }
    return pngUri(picture.width, picture.height, rgb);
}

std::string differenceScaleUri() {
    constexpr uint32_t kWidth = 128;
    std::vector<uint8_t> rgb;
    for (uint32_t x = 0; x < kWidth; ++x) {
        const std::array<uint8_t, 3> colour = colourOf(static_cast<int>(std::lround(std::pow(2.0, x * 7.0 / (kWidth - 1)))));
        rgb.insert(rgb.end(), colour.begin(), colour.end());
    }
    return pngUri(kWidth, 1, rgb);
}

std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63u];
    }
    return text;
}

}  // namespace cost
