#include <cmath>

#include "noise.hpp"
#include "picture.hpp"

namespace samples {
namespace {

double fractal(const glm::dvec3& p, int octaves) {
    double sum = 0;
    for (int octave = 0; octave < octaves; ++octave) sum += valueNoise(p * double(1 << octave) + 31.0 * octave) / (2 << octave);
    return sum;
}

/// Sawn along the trunk: year rings as bent lines, pores as short dark strokes. `x` along the grain, `z` across, in planks.
glm::dvec3 plank(double x, double z, int number) {
    const double shift = 17.3 * number;
    const double bend = 1.7 * valueNoise({0.8 * x + shift, 1.4 * z, 3}) + 0.35 * fractal({2.6 * x, 7 * z + shift, 9}, 3);
    const double rings = 6 * (z + bend);
    const double ring = rings - std::floor(rings);
    const double late = glm::smoothstep(0.35, 0.92, ring) * (1 - glm::smoothstep(0.92, 1.0, ring));
    const double fibre = fractal({2 * x, 90 * z, shift}, 3);
    const double pore = glm::smoothstep(0.63, 0.72, valueNoise({14 * x, 150 * z, shift + 5}));
    const double tone = 0.82 + 0.3 * lattice({number, 7, 1});
    glm::dvec3 color = glm::mix(glm::dvec3(0.21, 0.10, 0.045), glm::dvec3(0.07, 0.028, 0.012), 0.75 * late);
    color *= tone * (0.86 + 0.3 * fibre);
    return color * (1 - 0.35 * pore);
}

}  // namespace

Picture wood(int width, int height) {
    constexpr int kPlanks = 5;
    return paint(width, height, [](double u, double v) {
        const double across = v * kPlanks;
        const int number = static_cast<int>(std::floor(across));
        const double inPlank = across - number;
        const double edge = std::min(inPlank, 1 - inPlank);
        return plank(4 * u + 1.3 * number, inPlank, number) * glm::mix(0.25, 1.0, glm::smoothstep(0.0, 0.012, edge));
    });
}

}  // namespace samples
