#include "spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

constexpr double kFirst = 0.38;  // micrometres
constexpr double kStep = 0.005;

// CIE 015:2018, Colorimetry: the 1931 standard observer, also at cvrl.org.
const std::array<glm::dvec3, kSpectrumSteps> kColorMatching = {{
    {0.001368, 0.000039, 0.00645},
    {0.002236, 0.000064, 0.01055},
    {0.004243, 0.00012, 0.02005},
    {0.00765, 0.000217, 0.03621},
    {0.01431, 0.000396, 0.06785},
    {0.02319, 0.00064, 0.1102},
    {0.04351, 0.00121, 0.2074},
    {0.07763, 0.00218, 0.3713},
    {0.13438, 0.004, 0.6456},
    {0.21477, 0.0073, 1.03905},
    {0.2839, 0.0116, 1.3856},
    {0.3285, 0.01684, 1.62296},
    {0.34828, 0.023, 1.74706},
    {0.34806, 0.0298, 1.7826},
    {0.3362, 0.038, 1.77211},
    {0.3187, 0.048, 1.7441},
    {0.2908, 0.06, 1.6692},
    {0.2511, 0.0739, 1.5281},
    {0.19536, 0.09098, 1.28764},
    {0.1421, 0.1126, 1.0419},
    {0.09564, 0.13902, 0.81295},
    {0.05795, 0.1693, 0.6162},
    {0.03201, 0.20802, 0.46518},
    {0.0147, 0.2586, 0.3533},
    {0.0049, 0.323, 0.272},
    {0.0024, 0.4073, 0.2123},
    {0.0093, 0.503, 0.1582},
    {0.0291, 0.6082, 0.1117},
    {0.06327, 0.71, 0.07825},
    {0.1096, 0.7932, 0.05725},
    {0.1655, 0.862, 0.04216},
    {0.22575, 0.91485, 0.02984},
    {0.2904, 0.954, 0.0203},
    {0.3597, 0.9803, 0.0134},
    {0.43345, 0.99495, 0.00875},
    {0.51205, 1, 0.00575},
    {0.5945, 0.995, 0.0039},
    {0.6784, 0.9786, 0.00275},
    {0.7621, 0.952, 0.0021},
    {0.8425, 0.9154, 0.0018},
    {0.9163, 0.87, 0.00165},
    {0.9786, 0.8163, 0.0014},
    {1.0263, 0.757, 0.0011},
    {1.0567, 0.6949, 0.001},
    {1.0622, 0.631, 0.0008},
    {1.0456, 0.5668, 0.0006},
    {1.0026, 0.503, 0.00034},
    {0.9384, 0.4412, 0.00024},
    {0.85445, 0.381, 0.00019},
    {0.7514, 0.321, 0.0001},
    {0.6424, 0.265, 0.00005},
    {0.5419, 0.217, 0.00003},
    {0.4479, 0.175, 0.00002},
    {0.3608, 0.1382, 0.00001},
    {0.2835, 0.107, 0},
    {0.2187, 0.0816, 0},
    {0.1649, 0.061, 0},
    {0.1212, 0.04458, 0},
    {0.0874, 0.032, 0},
    {0.0636, 0.0232, 0},
    {0.04677, 0.017, 0},
    {0.0329, 0.01192, 0},
    {0.0227, 0.00821, 0},
    {0.01584, 0.005723, 0},
    {0.011359, 0.004102, 0},
    {0.008111, 0.002929, 0},
    {0.00579, 0.002091, 0},
    {0.004109, 0.001484, 0},
    {0.002899, 0.001047, 0},
    {0.002049, 0.00074, 0},
    {0.00144, 0.00052, 0},
    {0.001, 0.000361, 0},
    {0.00069, 0.000249, 0},
    {0.000476, 0.000172, 0},
    {0.000332, 0.00012, 0},
    {0.000235, 0.000085, 0},
    {0.000166, 0.00006, 0},
    {0.000117, 0.000042, 0},
    {0.000083, 0.00003, 0},
    {0.000059, 0.000021, 0},
    {0.000042, 0.000015, 0},
}};

// CIE 015:2018, Colorimetry: standard illuminant D65, also ISO/CIE 11664-2.
const std::array<double, kSpectrumSteps> kDaylight = {{
    49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204, 91.486,  92.4589, 93.4318, 90.057,  86.6823, 95.7736, 104.865, 110.936,
    117.008, 117.41,  117.812, 116.336, 114.861, 115.392, 115.923, 112.367, 108.811, 109.082, 109.354, 108.578, 107.802, 106.296,
    104.79,  106.239, 107.689, 106.047, 104.405, 104.225, 104.046, 102.023, 100,     98.1671, 96.3342, 96.0611, 95.788,  92.2368,
    88.6856, 89.3459, 90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936, 83.2886, 83.4939, 83.6992, 81.863,  80.0268, 80.1207,
    80.2146, 81.2462, 82.2778, 80.281,  78.2842, 74.0027, 69.7213, 70.6652, 71.6091, 72.979,  74.349,  67.9765, 61.604,  65.7448,
    69.8856, 72.4863, 75.087,  69.3398, 63.5927, 55.0054, 46.4182, 56.6118, 66.8054, 65.0941, 63.3828,
}};

/// What a wavelength of daylight adds to a picture, between the tables' steps along straight lines.
glm::dvec3 responseAt(double micrometres) {
    const double at = std::clamp((micrometres - kFirst) / kStep, 0.0, static_cast<double>(kSpectrumSteps - 1));
    const auto i = std::min(static_cast<size_t>(at), kSpectrumSteps - 2);
    const double f = at - static_cast<double>(i);
    return linearSrgb(glm::mix(kColorMatching[i], kColorMatching[i + 1], f)) * glm::mix(kDaylight[i], kDaylight[i + 1], f);
}

double sizeOf(const glm::dvec3& rgb) {
    return std::abs(rgb.r) + std::abs(rgb.g) + std::abs(rgb.b);
}

}  // namespace

const std::array<glm::dvec3, kSpectrumSteps>& colorMatching() {
    return kColorMatching;
}

const std::array<double, kSpectrumSteps>& daylight() {
    return kDaylight;
}

glm::dvec3 linearSrgb(const glm::dvec3& xyz) {
    // IEC 61966-2-1:1999/AMD1:2003, by rows.
    return {3.2406255 * xyz.x - 1.5372080 * xyz.y - 0.4986286 * xyz.z, -0.9689307 * xyz.x + 1.8757561 * xyz.y + 0.0415175 * xyz.z,
            0.0557101 * xyz.x - 0.2040211 * xyz.y + 1.0569959 * xyz.z};
}

std::vector<Wavelength> whiteLight(size_t count) {
    constexpr size_t kCells = 8000;  // of 0.05 nm
    constexpr double kCell = kStep * (kSpectrumSteps - 1) / kCells;
    std::vector<double> upTo(kCells + 1, 0.0);  // the density's integral
    for (size_t i = 0; i < kCells; ++i)
        upTo[i + 1] = upTo[i] + sizeOf(responseAt(kFirst + (static_cast<double>(i) + 0.5) * kCell));

    std::vector<Wavelength> waves(count);
    glm::dvec3 sum(0);
    size_t cell = 0;
    for (size_t k = 0; k < count; ++k) {
        const double wanted = (static_cast<double>(k) + 0.5) / static_cast<double>(count) * upTo[kCells];
        while (upTo[cell + 1] < wanted) ++cell;
        const double f = (wanted - upTo[cell]) / (upTo[cell + 1] - upTo[cell]);
        waves[k].micrometres = kFirst + (static_cast<double>(cell) + f) * kCell;
        const glm::dvec3 response = responseAt(waves[k].micrometres);
        waves[k].rgb = response / sizeOf(response);
        sum += waves[k].rgb;
    }
    for (Wavelength& wave : waves) wave.rgb *= static_cast<double>(count) / sum;
    return waves;
}

}  // namespace minirtc
