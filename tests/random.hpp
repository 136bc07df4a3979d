// Random inputs that are the same on every machine.
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <random>

namespace test {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(seed) {}

    /// Uniform in [0,1).
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
    /// 0..count-1.
    uint32_t index(uint32_t count) { return static_cast<uint32_t>(uniform() * count); }
    bool coin() { return uniform() < 0.5; }
    /// Log-uniform from 10^-exponent to 10^exponent, with either sign.
    double spread(double exponent) { return std::pow(10.0, uniform(-exponent, exponent)) * (coin() ? 1 : -1); }

    /// Uniform in the cube [-half,half]^3.
    glm::dvec3 inCube(double half = 1) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    /// Uniform on the unit sphere.
    glm::dvec3 direction() {
        const double z = uniform(-1, 1);
        const double phi = uniform(0, 6.283185307179586);
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace test
