// The shader files that hold physics and numerics, compiled as C++: f32 is what the device computes, f64 the same in double.
// The order is that of a kernel's parts. Include it in one file of a program only: the shaders' functions are not inline.
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "minirt.h"

// Names that shaders/common/language.glsl gives in GLSL.
#define PRECISE
#define UNROLL
#define PI 3.14159265358979323846
#define HALF_PI 1.57079632679489661923
#define INV_PI 0.31830988618379067154
#define INV_TWO_PI 0.15915494309189533577

namespace shader_names {
using glm::abs;
using glm::bitfieldReverse;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::floatBitsToInt;
using glm::floatBitsToUint;
using glm::floor;
using glm::intBitsToFloat;
using glm::length;
using glm::log;
using glm::max;
using glm::min;
using glm::normalize;
using glm::sqrt;
using glm::uintBitsToFloat;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using uint = glm::uint;
}  // namespace shader_names

namespace f32 {
using namespace shader_names;
using real = float;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
constexpr real MACHINE_EPSILON = std::numeric_limits<real>::epsilon() / 2;
// clang-format off
#include "../shaders/common/extremes.glsl"
#include "../shaders/common/neighbours.glsl"
#include "../shaders/common/numerics.glsl"
#include "../shaders/common/pixel.glsl"
#include "../shaders/common/patterns.glsl"
#include "../shaders/bsdf/optics.glsl"
#include "../shaders/bsdf/medium.glsl"
#include "../shaders/bsdf/dispersion.glsl"
#include "../shaders/sampling/random.glsl"
#include "../shaders/sampling/warp.glsl"
#include "../shaders/sampling/cells.glsl"
#include "../shaders/sampling/filter.glsl"
#include "../shaders/bsdf/microfacet.glsl"
#include "../shaders/traverse/box.glsl"
#include "../shaders/traverse/grid_box.glsl"
#include "../shaders/traverse/triangle.glsl"
#include "../shaders/traverse/sphere.glsl"
// clang-format on
}  // namespace f32

namespace f64 {
using namespace shader_names;
using real = double;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
constexpr real MACHINE_EPSILON = std::numeric_limits<real>::epsilon() / 2;
inline real maxByBits(real a, real b) {
    return std::max(a, b);
}
inline real minByBits(real a, real b) {
    return std::min(a, b);
}
inline real nextUp(real x) {
    return std::nextafter(x, std::numeric_limits<real>::infinity());
}
inline real nextDown(real x) {
    return std::nextafter(x, -std::numeric_limits<real>::infinity());
}
// clang-format off
#include "../shaders/common/numerics.glsl"
#include "../shaders/common/pixel.glsl"
#include "../shaders/common/patterns.glsl"
#include "../shaders/bsdf/optics.glsl"
#include "../shaders/bsdf/medium.glsl"
#include "../shaders/bsdf/dispersion.glsl"
#include "../shaders/sampling/random.glsl"
#include "../shaders/sampling/warp.glsl"
#include "../shaders/sampling/cells.glsl"
#include "../shaders/sampling/filter.glsl"
#include "../shaders/bsdf/microfacet.glsl"
#include "../shaders/traverse/box.glsl"
#include "../shaders/traverse/triangle.glsl"
#include "../shaders/traverse/sphere.glsl"
// clang-format on
}  // namespace f64

#undef PRECISE
#undef UNROLL
#undef PI
#undef HALF_PI
#undef INV_PI
#undef INV_TWO_PI
