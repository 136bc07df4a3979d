// White light as wavelengths: what the eye makes of each, and which to follow.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace minirtc {

constexpr size_t kSpectrumSteps = 81;  // from 380 to 780 nm every 5 nm

/// CIE 1931 2-degree colour matching functions x, y, z.
const std::array<glm::dvec3, kSpectrumSteps>& colorMatching();

/// CIE standard illuminant D65, 100 at 560 nm.
const std::array<double, kSpectrumSteps>& daylight();

/// From CIE XYZ to linear sRGB, which may be negative.
glm::dvec3 linearSrgb(const glm::dvec3& xyz);

struct Wavelength {
    glm::dvec3 rgb{0};  // by which light of this wavelength counts
    double micrometres = 0;
};

/// `count` wavelengths of D65 that stand for equal shares of |r| + |g| + |b|, so that no colour is large. The mean of all colours is white.
std::vector<Wavelength> whiteLight(size_t count);

}  // namespace minirtc
