// What of a scene gives light.
#pragma once
#include "scene.hpp"

namespace minirtc {

/// Of linear sRGB (ITU-R BT.709), in double.
double luminance(const glm::dvec3& color);

/// Radiance of a surface of this material, its texture averaged; 0 where it shines nowhere. A checker's is that of its two materials, averaged.
glm::dvec3 meanEmission(const Material& material, const Scene& scene);

/// True where the background is not black throughout.
bool backgroundShines(const Scene& scene);

/// True where anything gives light: a light, a material (in use or not), or the background.
bool anythingShines(const Scene& scene);

}  // namespace minirtc
