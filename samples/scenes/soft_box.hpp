// Panoramas as functions of the direction, and the lamps that light them.
#pragma once
#include "picture.hpp"

namespace samples {

/// `azimuth` in degrees to the right of -Z, `elevation` above the horizon.
glm::dvec3 toward(double azimuth, double elevation);

/// A lamp in the sky: a rectangle around `centre`, half extents and the width of its soft edge as tangents.
struct SoftBox {
    glm::dvec3 centre;  // unit
    double halfWidth;
    double halfHeight;
    glm::dvec3 radiance;
    double edge = 0.06;
};

/// What the lamp adds in the direction `d` (unit).
glm::dvec3 glow(const SoftBox& box, const glm::dvec3& d);

/// Equirectangular, +Y at the top row, -Z at u = 1/4.
Picture panorama(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance);

}  // namespace samples
