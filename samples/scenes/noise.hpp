// Noise without tables: pure functions of the place.
#pragma once
#include <glm/glm.hpp>

namespace samples {

/// Uniform in [0,1), by lattice point.
double lattice(const glm::ivec3& p);

/// In [0,1), smooth, a new value each unit.
double valueNoise(const glm::dvec3& p);

}  // namespace samples
