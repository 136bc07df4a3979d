#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "noise.hpp"
#include "soft_box.hpp"

namespace samples {
namespace {

/// A round lamp of angular radius `radius`, or its blurred picture where `edge` is wide; all in radians, small.
struct Lamp {
    glm::dvec3 centre;  // unit
    double radius;
    double edge;
    glm::dvec3 radiance;
};

glm::dvec3 glow(const Lamp& lamp, const glm::dvec3& d) {
    const double away = glm::distance(d, lamp.centre);  // the chord: all lamps are small
    return lamp.radiance * (1 - glm::smoothstep(lamp.radius - lamp.edge, lamp.radius + lamp.edge, away));
}

template <typename Light>
glm::dvec3 sum(const std::vector<Light>& lights, const glm::dvec3& d) {
    glm::dvec3 total{0};
    for (const Light& light : lights) total += glow(light, d);
    return total;
}

/// Small bright lamps on rings overhead, no two alike: what makes cut stones sparkle. None low in front of the camera.
std::vector<Lamp> sparkle() {
    std::vector<Lamp> result;
    const auto ring = [&](int count, double elevation, double size, double strength) {
        for (int i = 0; i < count; ++i) {
            const auto random = [&](int k) { return lattice({i, static_cast<int>(elevation), k}); };
            const double azimuth = 360.0 * (i + 0.6 * random(0)) / count;
            const bool front = std::min(azimuth, 360 - azimuth) < 42;
            if (front && elevation < 50) continue;
            const glm::dvec3 tint = glm::mix(glm::dvec3(1.25, 0.92, 0.6), glm::dvec3(0.65, 0.95, 1.4), random(1));
            result.push_back({toward(azimuth, elevation + 9 * random(3)), size * (0.7 + 0.6 * random(2)), 0.01, strength * tint});
        }
    };
    ring(13, 22, 0.030, 24);
    ring(11, 43, 0.036, 28);
    ring(5, 62, 0.042, 28);
    return result;
}

/// Dark walls, a cool backdrop lit from below at -Z, a black floor.
glm::dvec3 studioRoom(const glm::dvec3& d) {
    const double wall = glm::smoothstep(-0.08, 0.1, d.y);
    const glm::dvec3 shade = glm::mix(glm::dvec3(0.005, 0.005, 0.007), glm::dvec3(0.018, 0.021, 0.032), wall);
    const double sideways = std::atan2(d.x, -d.z) / 0.42;
    const double upwards = (std::asin(glm::clamp(d.y, -1.0, 1.0)) - 0.02) / 0.26;
    const double spot = std::exp(-sideways * sideways - upwards * upwards);
    return shade + glm::dvec3(0.16, 0.27, 0.46) * spot * glm::smoothstep(-0.05, 0.02, d.y);
}

/// What a lens that looks at something near makes of the lamps of a bar: soft discs, most of them low and warm.
std::vector<Lamp> blurredLamps() {
    const glm::dvec3 tints[] = {{1.0, 0.50, 0.14}, {1.0, 0.66, 0.30}, {1.0, 0.30, 0.08}, {0.95, 0.78, 0.52}, {0.20, 0.55, 0.62}};
    std::vector<Lamp> result;
    constexpr int kLamps = 150;
    for (int i = 0; i < kLamps; ++i) {
        const auto random = [&](int k) { return lattice({i, 5, k}); };
        const double elevation = -3 + 27 * random(0) * random(0);
        const double strength = 0.10 + 1.1 * random(2) * random(2);
        const double radius = 0.016 + 0.026 * random(3);
        result.push_back({toward(360.0 * (i + random(1)) / kLamps, elevation), radius, 0.008,
                          strength * tints[static_cast<size_t>(5 * random(4))]});
    }
    return result;
}

glm::dvec3 barRoom(const glm::dvec3& d) {
    const double sideways = std::atan2(d.x, -d.z) / 0.34;
    const double upwards = (std::asin(glm::clamp(d.y, -1.0, 1.0)) + 0.09) / 0.13;
    const glm::dvec3 shelf = glm::dvec3(1.0, 0.52, 0.19) * std::exp(-sideways * sideways - upwards * upwards);  // lit from behind
    const glm::dvec3 low = glm::dvec3(0.050, 0.024, 0.012) * std::exp(-12 * d.y * d.y) * (0.5 + valueNoise(d * 3.0));
    return shelf + low + glm::dvec3(0.008, 0.008, 0.011) * (1 + 0.5 * d.y);
}

}  // namespace

Picture studio(int width, int height) {
    const std::vector<SoftBox> boxes{{toward(-78, 22), 0.16, 0.62, {1.7, 2.5, 3.8}, 0.03},  // cool strip on the left
                                     {toward(82, 26), 0.11, 0.7, {4.0, 2.6, 1.4}, 0.03},    // warm strip on the right
                                     {toward(172, 48), 0.36, 0.22, {1.5, 1.5, 1.6}, 0.04},  // behind the camera
                                     {toward(0, 81), 0.26, 0.26, {1.7, 1.9, 2.3}, 0.04}};   // overhead
    const std::vector<Lamp> lamps = sparkle();
    return panorama(width, height, [&](const glm::dvec3& d) { return studioRoom(d) + sum(boxes, d) + sum(lamps, d); });
}

Picture softBoxes(int width, int height) {
    const std::vector<SoftBox> boxes{{toward(-72, 28), 0.55, 0.75, {7.5, 7.1, 6.5}, 0.05},     // key on the left
                                     {toward(84, 24), 0.16, 0.85, {6.0, 6.6, 7.6}, 0.03},      // strip on the right
                                     {toward(10, 78), 0.60, 0.38, {5.5, 5.5, 5.6}, 0.06},      // overhead
                                     {toward(170, 30), 0.30, 0.30, {1.2, 1.25, 1.35}, 0.05}};  // behind the camera
    return panorama(width, height, [&](const glm::dvec3& d) {
        const double wall = 0.05 + 0.05 * glm::smoothstep(-0.3, 0.6, d.y);
        return glm::dvec3(wall) + sum(boxes, d);
    });
}

Picture bar(int width, int height) {
    const std::vector<SoftBox> boxes{{toward(-84, 24), 0.13, 0.5, {4.2, 4.0, 3.8}, 0.04},  // window on the left
                                     {toward(76, 20), 0.06, 0.55, {5.2, 3.6, 2.0}, 0.03},  // tube on the right
                                     {toward(178, 42), 0.4, 0.2, {1.6, 1.3, 1.0}, 0.05},   // behind the camera
                                     {toward(20, 66), 0.5, 0.12, {3.4, 2.7, 1.9}, 0.05}};  // over the counter
    const std::vector<Lamp> lamps = blurredLamps();
    return panorama(width, height, [&](const glm::dvec3& d) { return barRoom(d) + sum(boxes, d) + sum(lamps, d); });
}

}  // namespace samples
