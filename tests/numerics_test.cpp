#include <doctest/doctest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <vector>

#include "exact.hpp"
#include "random.hpp"
#include "shader_source.hpp"

using glm::dvec3;
using glm::vec2;
using glm::vec3;
using test::exact;
using test::exact3;
using test::Random;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDenormal = std::numeric_limits<float>::denorm_min();

bool sameBits(float a, float b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Length of the step between two places in the panorama, where u wraps around.
double stepBetween(const vec2& a, const vec2& b) {
    const double du = std::abs(static_cast<double>(a.x) - b.x);
    return std::max(std::min(du, 1 - du), std::abs(static_cast<double>(a.y) - b.y));
}

}  // namespace

TEST_CASE("nextUp and nextDown are the neighbours that the standard library gives") {
    std::vector<float> values = {
        0.0f, -0.0f, kDenormal, -kDenormal, 3 * kDenormal, FLT_MIN,       -FLT_MIN, std::nextafter(FLT_MIN, 0.0f),
        1.0f, -1.0f, 2.0f,      FLT_MAX,    -FLT_MAX,      0x1.fffffep-1f};
    Random random(1);
    for (int i = 0; i < 1000000; ++i) {
        const auto bits = random.index(0xffffffffu);
        const float value = glm::uintBitsToFloat(bits);
        if (std::isfinite(value)) values.push_back(value);
    }
    int wrong = 0;
    for (const float value : values) {
        wrong += f32::nextUp(value) != std::nextafter(value, kInfinity);
        wrong += f32::nextDown(value) != std::nextafter(value, -kInfinity);
    }
    CHECK(wrong == 0);
    CHECK(f32::nextUp(-0.0f) == kDenormal);
    CHECK(f32::nextDown(0.0f) == -kDenormal);
    CHECK(f32::nextUp(FLT_MAX) == kInfinity);
}

TEST_CASE("roundAway follows the sign of the direction") {
    CHECK(f32::roundAway(1, 2) == std::nextafter(1.0f, 2.0f));
    CHECK(f32::roundAway(1, -2) == std::nextafter(1.0f, 0.0f));
    CHECK(f32::roundAway(-1, 1e-30f) == std::nextafter(-1.0f, 0.0f));
    CHECK(sameBits(f32::roundAway(1, 0), 1));
    CHECK(sameBits(f32::roundAway(-0.0f, 0), -0.0f));
}

TEST_CASE("errorGamma bounds chains of roundings") {
    Random random(2);
    for (const int n : {1, 3, 7, 20}) {
        double worst = 0;
        for (int i = 0; i < 100000; ++i) {
            auto product = static_cast<float>(random.uniform(0.5, 2));
            exact expected = product;
            for (int k = 0; k < n; ++k) {
                const auto factor = static_cast<float>(random.uniform(0.5, 2));
                product *= factor;
                expected *= exact(factor);
            }
            worst = std::max(worst, static_cast<double>(std::abs(product / expected - 1)));
        }
        CAPTURE(n);
        CHECK(worst <= f32::errorGamma(n));
        CHECK(worst > 0.1 * f32::errorGamma(n));
    }
    CHECK(f64::errorGamma(1) == doctest::Approx(0x1p-53).epsilon(1e-9));
}

TEST_CASE("unitVector works where squares overflow or vanish") {
    Random random(3);
    double worst = 0;
    double worstTurn = 0;
    for (int i = 0; i < 200000; ++i) {
        const exact scale = std::pow(exact(10), exact(random.uniform(-36, 36)));
        const exact3 wanted = exact3(random.direction()) * scale;
        const vec3 v(wanted);
        const vec3 unit = f32::unitVector(v);
        worst = std::max(worst, static_cast<double>(std::abs(glm::length(exact3(unit)) - 1)));
        worstTurn = std::max(worstTurn, static_cast<double>(glm::length(glm::cross(exact3(unit), glm::normalize(exact3(v))))));
    }
    MESSAGE("length off by ", worst, ", direction by ", worstTurn);
    CHECK(worst <= 3e-7);
    CHECK(worstTurn <= 3e-7);
    CHECK(f32::unitVector(vec3(1e30f, 0, 0)) == vec3(1, 0, 0));
    CHECK(f32::unitVector(vec3(0, -1e-30f, 0)) == vec3(0, -1, 0));
    CHECK(f32::unitVector(vec3(0, 0, kDenormal)) == vec3(0, 0, 1));
    CHECK(f32::unitVector(vec3(1e30f, 1e-30f, 0)) == vec3(1, 0, 0));
    CHECK(f32::unitVector(vec3(0)) == vec3(0));
}

TEST_CASE("atan2Portable over all quadrants") {
    Random random(4);
    double worst = 0;
    double worstInDouble = 0;
    for (int i = 0; i < 2000000; ++i) {
        const dvec3 d = random.direction();
        const double shrink = random.coin() ? 1 : std::pow(10.0, random.uniform(-20, 0));
        const auto y = static_cast<float>(d.y * shrink);
        const auto x = static_cast<float>(random.coin() ? d.x : d.x * shrink);
        const exact expected = std::atan2(static_cast<exact>(y), static_cast<exact>(x));
        worst = std::max(worst, static_cast<double>(std::abs(f32::atan2Portable(y, x) - expected)));
        worstInDouble = std::max(worstInDouble, static_cast<double>(std::abs(f64::atan2Portable(y, x) - expected)));
    }
    MESSAGE("largest error ", worst, ", in double ", worstInDouble);
    CHECK(worst <= 3e-7);
    CHECK(worstInDouble <= 2e-8);
    CHECK(f32::atan2Portable(0, 0) == 0);
    CHECK(f32::atan2Portable(0, 1) == 0);
    CHECK(f32::atan2Portable(0, -1) == doctest::Approx(3.14159265).epsilon(1e-7));
    CHECK(f32::atan2Portable(1, 0) == doctest::Approx(1.57079633).epsilon(1e-7));
    CHECK(f32::atan2Portable(-1, 0) == doctest::Approx(-1.57079633).epsilon(1e-7));
}

TEST_CASE("the panorama has the top row up and the middle at minus z turned by a quarter") {
    const auto near = [](const vec2& a, const vec2& b) { return stepBetween(a, b) < 2e-7; };
    CHECK(near(f32::equirectUv(vec3(0, 0, -1), 0), vec2(0.25f, 0.5f)));
    CHECK(near(f32::equirectUv(vec3(1, 0, 0), 0), vec2(0.5f, 0.5f)));
    CHECK(near(f32::equirectUv(vec3(0, 0, 1), 0), vec2(0.75f, 0.5f)));
    CHECK(near(f32::equirectUv(vec3(-1, 0, 0), 0), vec2(0, 0.5f)));
    CHECK(near(f32::equirectUv(vec3(0, 0, -1), 0.5f), vec2(0.75f, 0.5f)));
    CHECK(f32::equirectUv(vec3(0, 1, 0), 0).y == 0);
    CHECK(f32::equirectUv(vec3(0, -1, 0), 0).y == doctest::Approx(1).epsilon(1e-7));
}

TEST_CASE("the panorama has neither holes nor jumps at the poles and the seam") {
    Random random(5);
    int outside = 0;
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
        dvec3 d = random.direction();
        if (i % 4 == 1) d = glm::normalize(d * dvec3(1e-6, 1, 1e-6));                // a pole
        if (i % 4 == 2) d = glm::normalize(dvec3(-std::abs(d.x), d.y, d.z * 1e-7));  // the seam
        const auto turns = static_cast<float>(random.uniform(-2, 2));
        const vec2 uv = f32::equirectUv(vec3(d), turns);
        outside += !(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1.0000002f);
        // Against closed forms; at the poles u means nothing but the distance travelled does.
        const vec3 rounded(d);
        const exact3 r(rounded);
        const exact horizontal = std::sqrt(r.x * r.x + r.z * r.z);
        const exact u = std::atan2(r.z, r.x) / (2 * exact(3.141592653589793238L)) + 0.5L + exact(turns);
        const exact v = std::atan2(horizontal, r.y) / exact(3.141592653589793238L);
        worst = std::max(worst, stepBetween(uv, vec2(static_cast<float>(u - std::floor(u)), static_cast<float>(v))));
    }
    MESSAGE("largest error of texture coordinates ", worst);
    CHECK(outside == 0);
    CHECK(worst <= 4e-7);
    for (const float zero : {0.0f, -0.0f}) {
        for (const float y : {1.0f, -1.0f}) {
            const vec2 uv = f32::equirectUv(vec3(zero, y, -zero), 0);
            CHECK((uv.x >= 0 && uv.x <= 1));
            CHECK(uv.y == doctest::Approx(y > 0 ? 0 : 1));
        }
    }
}
