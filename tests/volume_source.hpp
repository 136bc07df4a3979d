// shaders/media/volumes.glsl as C++, for lists of 9, 2 and 1 entries. Include it in one file of a program only.
#pragma once
#include <glm/glm.hpp>

#define UNROLL

namespace shader_names_of_volumes {
using glm::clamp;
using glm::max;
using uint = glm::uint;
}  // namespace shader_names_of_volumes

// clang-format off
#define VOLUME_CAPACITY 9
namespace nine {
using namespace shader_names_of_volumes;
#include "../shaders/media/volumes.glsl"
}  // namespace nine
#undef VOLUME_CAPACITY
#define VOLUME_CAPACITY 2
namespace two {
using namespace shader_names_of_volumes;
#include "../shaders/media/volumes.glsl"
}  // namespace two
#undef VOLUME_CAPACITY
#define VOLUME_CAPACITY 1
namespace one {
using namespace shader_names_of_volumes;
#include "../shaders/media/volumes.glsl"
}  // namespace one
#undef VOLUME_CAPACITY
// clang-format on

#undef UNROLL
