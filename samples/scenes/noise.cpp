#include "noise.hpp"

#include <cstdint>

namespace samples {

double lattice(const glm::ivec3& p) {  // finaliser of MurmurHash3, A. Appleby
    uint32_t h =
        static_cast<uint32_t>(p.x) * 73856093u ^ static_cast<uint32_t>(p.y) * 19349663u ^ static_cast<uint32_t>(p.z) * 83492791u;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return (h ^ h >> 16) / 4294967296.0;
}

double valueNoise(const glm::dvec3& p) {
    const glm::dvec3 cell = glm::floor(p);
    const glm::dvec3 t = glm::smoothstep(glm::dvec3(0), glm::dvec3(1), p - cell);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset{corner & 1, corner >> 1 & 1, corner >> 2};
        const glm::dvec3 weight = glm::mix(1.0 - t, t, glm::dvec3(offset));
        sum += weight.x * weight.y * weight.z * lattice(glm::ivec3(cell) + offset);
    }
    return sum;
}

}  // namespace samples
