#include <cmath>
#include <glm/gtc/constants.hpp>

#include "picture.hpp"

namespace samples {
namespace {

/// 1 inside of |x| < half, 0 outside, with an edge that a magnified texture does not show as steps.
double stroke(double x, double half) {
    return 1 - glm::smoothstep(half - 0.003, half + 0.003, std::abs(x));
}

/// A row of `count` petals whose tips point up, between v = base and v = tip.
double petals(double u, double v, int count, double base, double tip) {
    const double along = (base - v) / (base - tip);
    if (along < 0 || along > 1) return 0;
    const double across = std::abs(u * count - std::floor(u * count) - 0.5);
    const double outline = 0.46 * std::sqrt(std::sin(glm::pi<double>() * (0.12 + 0.88 * along)));
    const double leaf = 1 - glm::smoothstep(outline - 0.02, outline + 0.02, across);
    const double vein = glm::smoothstep(outline - 0.17, outline - 0.13, across) + stroke(across, 0.03);
    return leaf * glm::clamp(vein + 0.28, 0.0, 1.0);
}

constexpr double kAspect = 0.95;  // of the vase where it is widest: once around over the length of its profile

/// Round flowers in a row about v = middle.
double flowers(double u, double v, int count, double middle, double size) {
    const glm::dvec2 p = glm::dvec2{(u * count - std::floor(u * count) - 0.5) / count * kAspect, v - middle} / size;
    const double radius = glm::length(p);
    const double lobes = 0.78 + 0.22 * std::cos(6 * std::atan2(p.y, p.x));
    const double blossom = 1 - glm::smoothstep(lobes - 0.05, lobes + 0.05, radius);
    const double heart = 1 - glm::smoothstep(0.2, 0.26, radius);
    const double ring = stroke(radius - 0.42, 0.05);
    return glm::clamp(blossom * (0.55 + 0.45 * radius) - ring * 0.8 - heart, 0.0, 1.0);
}

}  // namespace

Picture porcelain(int width, int height) {
    const glm::dvec3 glaze{0.86, 0.87, 0.85};
    const glm::dvec3 cobalt{0.012, 0.05, 0.30};
    return paint(width, height, [&](double u, double v) {
        double ink = 0;
        for (const double band : {0.345, 0.475, 0.488, 0.70, 0.715, 0.90}) ink = glm::max(ink, stroke(v - band, 0.005));
        ink = glm::max(ink, petals(u, v, 14, 0.89, 0.73));
        ink = glm::max(ink, flowers(u, v, 7, 0.59, 0.06));
        ink = glm::max(ink, 0.85 * flowers(u + 0.5 / 7, v, 7, 0.59, 0.028));
        ink = glm::max(ink, petals(u, v, 8, 0.465, 0.37));
        return glm::mix(glaze, cobalt, ink);
    });
}

}  // namespace samples
