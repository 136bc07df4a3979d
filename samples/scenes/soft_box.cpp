#include "soft_box.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace samples {

glm::dvec3 toward(double azimuth, double elevation) {
    const double a = glm::radians(azimuth);
    const double e = glm::radians(elevation);
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

glm::dvec3 glow(const SoftBox& box, const glm::dvec3& d) {
    const double ahead = glm::dot(d, box.centre);
    if (ahead <= 0) return glm::dvec3(0);
    const glm::dvec3 right = glm::normalize(glm::cross(box.centre, glm::dvec3(0, 1, 1e-3)));
    const glm::dvec3 up = glm::cross(right, box.centre);
    const double x = std::abs(glm::dot(d, right)) / ahead;
    const double y = std::abs(glm::dot(d, up)) / ahead;
    return box.radiance * (1 - glm::smoothstep(box.halfWidth - box.edge, box.halfWidth + box.edge, x)) *
           (1 - glm::smoothstep(box.halfHeight - box.edge, box.halfHeight + box.edge, y));
}

Picture panorama(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    return paint(width, height, [&](double u, double v) {
        const double azimuth = glm::two_pi<double>() * (u - 0.5);
        const double polar = glm::pi<double>() * v;
        return radiance({std::cos(azimuth) * std::sin(polar), std::cos(polar), std::sin(azimuth) * std::sin(polar)});
    });
}

}  // namespace samples
