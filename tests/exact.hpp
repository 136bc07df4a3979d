// Arithmetic that judges float: 64-bit significands, so that sums and products of a few floats are exact or nearly so.
#pragma once
#include <glm/glm.hpp>

namespace test {

using exact = long double;
using exact3 = glm::vec<3, long double>;

/// Distance along the line to the plane of the triangle; not finite where they are parallel.
inline exact planeDistance(const glm::vec3& origin, const glm::vec3& direction, const glm::vec3 (&v)[3]) {
    const exact3 n = glm::cross(exact3(v[1]) - exact3(v[0]), exact3(v[2]) - exact3(v[0]));
    return glm::dot(n, exact3(v[0]) - exact3(origin)) / glm::dot(n, exact3(direction));
}

}  // namespace test
