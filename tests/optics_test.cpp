#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "exact.hpp"
#include "random.hpp"
#include "shader_source.hpp"

// The path of a ray that is reflected inside of a unit cube, in float and in double.
namespace f32 {
#include "cube_path.inl"
}
namespace f64 {
#include "cube_path.inl"
}

using glm::dvec3;
using glm::vec3;
using test::exact;
using test::exact3;
using test::Random;

namespace {

/// The unit direction that meets the normal +y at angle `theta` (radians).
dvec3 arriving(double theta) {
    return {std::sin(theta), -std::cos(theta), 0};
}

/// A unit direction against n, and n, in any attitude.
struct Encounter {
    vec3 d;
    vec3 n;
};

Encounter encounter(double theta, Random& random) {
    const dvec3 n = random.direction();
    const dvec3 t = glm::normalize(glm::cross(n, random.direction()));
    return {vec3(t * std::sin(theta) - n * std::cos(theta)), vec3(n)};
}

bool finite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool sameBits(const vec3& a, const vec3& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

exact sin2(const vec3& a, const vec3& b) {
    const exact3 across = glm::cross(exact3(a), exact3(b));
    return glm::dot(across, across) / (glm::dot(exact3(a), exact3(a)) * glm::dot(exact3(b), exact3(b)));
}

constexpr double kDegree = 0.017453292519943295;
const double kEtas[] = {0.25, 1 / 2.42, 1 / 1.5, 0.9999, 1, 1.0001, 1.3334, 1.5, 2.42, 4};

}  // namespace

TEST_CASE("Fresnel at normal incidence") {
    for (const double eta : kEtas) {
        const double r = (eta - 1) / (eta + 1);
        CHECK(f32::meetInterface(vec3(0, -1, 0), vec3(0, 1, 0), static_cast<float>(eta)).reflectance ==
              doctest::Approx(r * r).epsilon(1e-6));
        CHECK(f64::meetInterface(dvec3(0, -1, 0), dvec3(0, 1, 0), eta).reflectance == doctest::Approx(r * r).epsilon(1e-12));
    }
}

TEST_CASE("Fresnel at the Brewster angle reflects one polarisation only") {
    for (const double eta : kEtas) {
        const double perpendicular = (1 - eta * eta) / (1 + eta * eta);
        const f64::Interface boundary = f64::meetInterface(arriving(std::atan(eta)), dvec3(0, 1, 0), eta);
        CHECK(boundary.reflectance == doctest::Approx(perpendicular * perpendicular / 2).epsilon(1e-9));
        CHECK(std::abs(glm::dot(boundary.reflected, boundary.refracted)) < 1e-9);
    }
}

TEST_CASE("Fresnel at grazing incidence and under total reflection reflects all") {
    for (const double eta : kEtas) {
        if (eta == 1) continue;
        const auto eta32 = static_cast<float>(eta);
        CHECK(f32::meetInterface(vec3(1, 0, 0), vec3(0, 1, 0), eta32).reflectance == 1);
        CHECK(f64::meetInterface(arriving(89.9999999 * kDegree), dvec3(0, 1, 0), eta).reflectance > 0.999);
        if (eta > 1) continue;
        const double critical = std::asin(eta);
        for (const double share : {0.01, 0.5, 1.0}) {
            const f32::Interface boundary =
                f32::meetInterface(vec3(arriving(critical + share * (90 * kDegree - critical))), vec3(0, 1, 0), eta32);
            CHECK(boundary.totalReflection);
            CHECK(boundary.reflectance == 1);
        }
    }
}

TEST_CASE("Fresnel matches the tangent and sine laws and their transmittances add up to 1") {
    double worst = 0;
    double worstEnergy = 0;
    for (const double eta : kEtas) {
        if (eta == 1) continue;
        for (double degrees = 0.5; degrees < 90; degrees += 0.5) {
            const double i = degrees * kDegree;
            if (std::sin(i) >= eta) continue;
            const double t = std::asin(std::sin(i) / eta);
            const double perpendicular = std::sin(i - t) / std::sin(i + t);
            const double parallel = std::tan(i - t) / std::tan(i + t);
            const double expected = (perpendicular * perpendicular + parallel * parallel) / 2;
            const double reflectance = f64::meetInterface(arriving(i), dvec3(0, 1, 0), eta).reflectance;
            worst = std::max(worst, std::abs(reflectance - expected));
            // Transmitted power by its own formula.
            const double ts = 2 * std::cos(i) / (std::cos(i) + eta * std::cos(t));
            const double tp = 2 * std::cos(i) / (eta * std::cos(i) + std::cos(t));
            const double transmittance = eta * std::cos(t) / std::cos(i) * (ts * ts + tp * tp) / 2;
            worstEnergy = std::max(worstEnergy, std::abs(reflectance + transmittance - 1));
        }
    }
    CHECK(worst < 1e-12);
    CHECK(worstEnergy < 1e-12);
}

TEST_CASE("reflectance is the same from both sides and float agrees with double") {
    Random random(1);
    double worstReciprocity = 0;
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const double eta = std::exp(random.uniform(std::log(0.25), std::log(4.0)));
        const Encounter e = encounter(random.uniform(0, 89) * kDegree, random);
        const f64::Interface boundary = f64::meetInterface(glm::normalize(dvec3(e.d)), glm::normalize(dvec3(e.n)), eta);
        if (boundary.totalReflection) continue;
        const f64::Interface back = f64::meetInterface(-boundary.refracted, -glm::normalize(dvec3(e.n)), 1 / eta);
        worstReciprocity = std::max(worstReciprocity, std::abs(back.reflectance - boundary.reflectance));
        if (sin2(e.d, e.n) > static_cast<exact>(0.999 * eta * eta)) continue;  // the slope is infinite at the critical angle
        const f32::Interface single = f32::meetInterface(e.d, e.n, static_cast<float>(eta));
        worst = std::max(worst, std::abs(single.reflectance - boundary.reflectance));
    }
    MESSAGE("reflectance: both sides differ by ", worstReciprocity, ", float from double by ", worst);
    CHECK(worstReciprocity < 1e-9);
    CHECK(worst < 5e-5);
}

TEST_CASE("refracted rays obey Snell and stay in the plane of incidence and mirror rays keep the angle") {
    Random random(2);
    double worstSnell = 0;
    double worstMirror = 0;
    double worstLength = 0;
    for (int i = 0; i < 500000; ++i) {
        const double eta = std::exp(random.uniform(std::log(0.25), std::log(4.0)));
        const Encounter e = encounter(random.uniform(0, 90) * kDegree, random);
        const f32::Interface boundary = f32::meetInterface(e.d, e.n, static_cast<float>(eta));
        const exact3 mirrored =
            glm::normalize(exact3(e.d)) -
            exact(2) * glm::dot(glm::normalize(exact3(e.d)), glm::normalize(exact3(e.n))) * glm::normalize(exact3(e.n));
        worstMirror = std::max(worstMirror, static_cast<double>(glm::length(exact3(boundary.reflected) - mirrored)));
        worstLength = std::max(worstLength, static_cast<double>(std::abs(glm::length(exact3(boundary.reflected)) - 1)));
        if (boundary.totalReflection) continue;
        const exact3 n = glm::normalize(exact3(e.n));
        const exact3 residual = glm::cross(exact3(boundary.refracted), n) * exact(static_cast<float>(eta)) -
                                glm::cross(glm::normalize(exact3(e.d)), n);
        worstSnell = std::max(worstSnell, static_cast<double>(glm::length(residual)));
        worstLength = std::max(worstLength, static_cast<double>(std::abs(glm::length(exact3(boundary.refracted)) - 1)));
    }
    MESSAGE("Snell residual ", worstSnell, ", mirror ", worstMirror, ", length ", worstLength);
    CHECK(worstSnell <= 1.5e-6);
    CHECK(worstMirror <= 1e-6);
    CHECK(worstLength <= 2e-7);
}

TEST_CASE("total reflection is decided wrongly only next to the critical angle") {
    const struct {
        std::string name;
        double ior;
        double allowed;
    } glasses[] = {{"n = 1.5", 1.5, 8.8e-7}, {"diamond", 2.41748, 3.1e-6}};
    for (const auto& glass : glasses) {
        Random random(3);
        const auto eta = static_cast<float>(1 / glass.ior);
        double worst = 0;
        int wrong = 0;
        for (int i = 0; i < 1000000; ++i) {
            const double sin2C = 1 / (glass.ior * glass.ior);
            const double aim = sin2C * (1 + random.uniform(-1, 1) * std::pow(10.0, random.uniform(-8, -1)));
            const Encounter e = encounter(std::asin(std::sqrt(aim)), random);
            const exact sin2T = sin2(e.d, e.n) / (exact(eta) * exact(eta));
            if (f32::meetInterface(e.d, e.n, eta).totalReflection == (sin2T >= 1)) continue;
            ++wrong;
            worst = std::max(worst, static_cast<double>(std::abs(sin2T - 1)));
        }
        MESSAGE(glass.name, ": ", wrong, " of 1000000 wrong, all within ", worst, " of sin^2 = 1 of the refracted ray");
        CHECK(wrong > 0);
        CHECK(worst <= glass.allowed);
    }
}

TEST_CASE("an eta of 1 changes no bit of the direction") {
    Random random(4);
    int changed = 0;
    for (int i = 0; i < 100000; ++i) {
        const Encounter e = encounter(random.uniform(0, 90) * kDegree, random);
        const f32::Interface boundary = f32::meetInterface(e.d, e.n, 1);
        changed += !sameBits(boundary.refracted, e.d) || boundary.reflectance != 0 || boundary.totalReflection;
    }
    CHECK(changed == 0);
}

TEST_CASE("everything is finite from normal to grazing incidence") {
    Random random(5);
    int bad = 0;
    const auto judge = [&](const vec3& d, const vec3& n, float eta) {
        const f32::Interface boundary = f32::meetInterface(d, n, eta);
        bad += !finite(boundary.reflected) || !(boundary.reflectance >= 0 && boundary.reflectance <= 1.000001f);
        bad += !boundary.totalReflection && !finite(boundary.refracted);
    };
    for (const double eta : kEtas) {
        const auto eta32 = static_cast<float>(eta);
        for (const float near : {eta32, std::nextafter(eta32, 0.0f), std::nextafter(eta32, 9.0f)}) {
            judge(vec3(0, -1, 0), vec3(0, 1, 0), near);
            judge(vec3(1, 0, 0), vec3(0, 1, 0), near);
            judge(vec3(1, 1e-7f, 0), vec3(0, 1, 0), near);  // on the wrong side by a rounding
            judge(vec3(1, -1e-30f, 0), vec3(0, 1, 0), near);
            for (int i = 0; i < 20000; ++i) {
                const vec3 n(random.direction());
                judge(-n, n, near);
                const double angle = std::pow(10.0, random.uniform(-8, 0)) * 90 * kDegree;
                const Encounter e = encounter(random.coin() ? angle : 90 * kDegree - angle, random);
                judge(e.d, e.n, near);
            }
        }
    }
    CHECK(bad == 0);
}

TEST_CASE("long chains of total reflections in a cube stay on their path") {
    const auto largestError = [](int bounces, bool lifted) {
        Random random(6);
        double largest = 0;
        for (int i = 0; i < 40; ++i) {
            const vec3 start(random.inCube(0.4));
            const vec3 direction(random.direction());
            const dvec3 expected = f64::cubePath(dvec3(start), dvec3(direction), bounces, false);
            largest = std::max(largest, glm::length(dvec3(f32::cubePath(start, direction, bounces, lifted)) - expected));
        }
        return largest;
    };
    const double after64 = largestError(64, false);
    const double after4096 = largestError(4096, false);
    const double lifted64 = largestError(64, true);
    const double lifted4096 = largestError(4096, true);
    MESSAGE("largest position error after 64 bounces ", after64, ", after 4096 ", after4096, "; with lifted origins ", lifted64,
            ", ", lifted4096);
    CHECK(after64 <= 1.1e-5);
    CHECK(after4096 <= 2.0e-4);
    CHECK(lifted64 <= 1.1e-5);
    // Each lifted origin is ahead of the hit by up to 2e-7 across the wall, always inward, so this adds up.
    CHECK(lifted4096 <= 3.0e-4);
}

TEST_CASE("keepOnSide leaves no ray on the wrong side and the others as they are") {
    Random random(7);
    int wrong = 0;
    int touched = 0;
    int bent = 0;
    for (int i = 0; i < 1000000; ++i) {
        const vec3 side(random.direction());
        dvec3 w = random.direction();
        if (i % 2 == 1)
            w = glm::normalize(w - dvec3(side) * (glm::dot(w, dvec3(side)) * (1 - std::pow(10.0, random.uniform(-9, 0)))));
        const vec3 before(w);
        const vec3 after = f32::keepOnSide(before, side);
        wrong += !(glm::dot(exact3(after), exact3(side)) > 0);
        if (glm::dot(exact3(before), exact3(side)) > 4e-7L) touched += !sameBits(after, before);
        bent += std::abs(glm::length(exact3(after)) - 1) > 3e-7L;
    }
    CHECK(wrong == 0);
    CHECK(touched == 0);
    CHECK(bent == 0);
}
