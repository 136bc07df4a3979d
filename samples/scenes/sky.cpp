#include <cmath>

#include "noise.hpp"
#include "soft_box.hpp"

namespace samples {
namespace {

/// Streaks of cloud on a layer overhead, 0 to 1, thinning out towards the horizon's haze.
double clouds(const glm::dvec3& d) {
    const glm::dvec3 onLayer = glm::dvec3{d.x, 0, 2.2 * d.z} / (d.y + 0.18);
    double sum = 0;
    for (int octave = 0; octave < 5; ++octave) sum += valueNoise(onLayer * (1.7 * (1 << octave)) + 17.0 * octave) / (2 << octave);
    return glm::smoothstep(0.46, 0.78, sum) * glm::smoothstep(0.02, 0.25, d.y);
}

glm::dvec3 sky(const glm::dvec3& d) {
    const glm::dvec3 zenith{0.045, 0.085, 0.22};
    const glm::dvec3 middle{0.20, 0.26, 0.44};
    const glm::dvec3 horizon{0.88, 0.45, 0.25};
    const glm::dvec3 sunward = toward(13, 3.5);
    const double nearSun = 0.5 + 0.5 * glm::dot(d, sunward);
    const glm::dvec3 low = glm::mix(glm::dvec3(0.30, 0.27, 0.40), horizon, std::pow(nearSun, 3));
    glm::dvec3 color = glm::mix(low, middle, glm::smoothstep(0.0, 0.28, d.y));
    color = glm::mix(color, zenith, glm::smoothstep(0.15, 0.95, d.y));
    color = glm::mix(color, glm::mix(glm::dvec3(0.5, 0.42, 0.48), glm::dvec3(1.25, 0.78, 0.55), std::pow(nearSun, 4)),
                     0.75 * clouds(d));
    return color + glm::dvec3(0.9, 0.4, 0.14) * std::pow(nearSun, 80) + glm::dvec3(12, 7.5, 3.6) * std::pow(nearSun, 4000);
}

/// Height of a hill's outline above the horizon, as sine of the elevation.
double ridge(const glm::dvec3& d, double frequency, double height) {
    const glm::dvec3 around = glm::normalize(glm::dvec3{d.x, 0, d.z}) * frequency;
    return height * (0.25 + 0.9 * valueNoise(around + 40.0) + 0.35 * valueNoise(around * 2.9 + 90.0));
}

glm::dvec3 skyAndHills(const glm::dvec3& d) {
    constexpr double kSoft = 0.006;
    glm::dvec3 color = sky(d);
    const glm::dvec3 haze = sky(glm::normalize(glm::dvec3{d.x, 0.02, d.z}));
    const double far = ridge(d, 2.6, 0.085);
    const double near = ridge(d, 4.1, 0.045);
    color = glm::mix(glm::mix(glm::dvec3(0.10, 0.105, 0.19), haze, 0.30), color, glm::smoothstep(far - kSoft, far + kSoft, d.y));
    return glm::mix(glm::mix(glm::dvec3(0.035, 0.045, 0.085), haze, 0.08), color,
                    glm::smoothstep(near - kSoft, near + kSoft, d.y));
}

/// A lake: the sky upside down, weaker the steeper one looks.
glm::dvec3 lake(const glm::dvec3& d) {
    const double mirror = 0.06 + 0.7 * std::exp(6 * d.y);
    return glm::dvec3(0.02, 0.03, 0.045) + mirror * skyAndHills(glm::normalize(glm::dvec3{d.x, -1.15 * d.y, d.z}));
}

/// Blue with white clouds over green hills and the same lake.
glm::dvec3 noon(const glm::dvec3& d) {
    glm::dvec3 color = glm::mix(glm::dvec3(0.72, 0.86, 1.0), glm::dvec3(0.13, 0.34, 0.86), glm::smoothstep(0.0, 0.75, d.y));
    color = glm::mix(color, glm::dvec3(1.35, 1.35, 1.32), 0.9 * clouds(d));
    const double far = ridge(d, 2.6, 0.14);
    const double near = ridge(d, 4.1, 0.06);
    color = glm::mix(glm::dvec3(0.27, 0.40, 0.50), color, glm::smoothstep(far - 0.004, far + 0.004, d.y));
    return glm::mix(glm::dvec3(0.10, 0.24, 0.12), color, glm::smoothstep(near - 0.004, near + 0.004, d.y));
}

}  // namespace

Picture noonSky(int width, int height) {
    const glm::dvec3 sun = toward(-40, 67);
    return panorama(width, height, [&](const glm::dvec3& d) {
        if (d.y > 0) {
            const double near = 0.5 + 0.5 * glm::dot(d, sun);
            return noon(d) + glm::dvec3(1.2, 1.1, 0.9) * std::pow(near, 60) + glm::dvec3(40, 38, 32) * std::pow(near, 6000);
        }
        const double mirror = 0.04 + 0.5 * std::exp(8 * d.y);
        return glm::dvec3(0.03, 0.15, 0.21) + mirror * noon(glm::normalize(glm::dvec3{d.x, -1.15 * d.y, d.z}));
    });
}

Picture eveningSky(int width, int height) {
    const SoftBox boxes[] = {{toward(-118, 38), 0.52, 0.34, {6.5, 5.8, 5.0}},  // key, behind the camera's left shoulder
                             {toward(128, 32), 0.14, 0.5, {3.0, 4.2, 6.0}},    // cool strip on the right
                             {toward(0, 74), 0.42, 0.2, {3.2, 3.3, 3.5}}};     // overhead
    return panorama(width, height, [&](const glm::dvec3& d) {
        glm::dvec3 color = d.y > 0 ? skyAndHills(d) : lake(d);
        for (const SoftBox& box : boxes) color += glow(box, d);
        return color;
    });
}

}  // namespace samples
