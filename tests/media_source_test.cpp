// Ways through slabs and concentric balls by the shader's own functions in single precision, against the figures of the closed form.
#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "shader_source.hpp"
#include "volume_source.hpp"

namespace {

using f32::vec3;

constexpr double kPi = 3.14159265358979323846;
constexpr float kIor[] = {1.0f, 1.5f, 1.36f, 1.31f};  // by medium: surrounding, glass, whisky, ice, each inside of the one before
constexpr float kSigma[] = {0.0f, 0.7f, 0.4f, 0.2f};

struct Way {
    vec3 p, d;
    nine::VolumeList volumes{};
    double transmittance = 1, lengths[4] = {};
    float absorbed = 1;

    /// Over a distance `t` and through the surface of the volume of `medium` there; `out` is its normal.
    void cross(float t, glm::uint medium, const vec3& out) {
        const bool entering = glm::dot(d, out) < 0;
        const nine::Crossing crossing = nine::crossOrdered(volumes, medium, entering, false);
        lengths[crossing.from] += double(t);
        absorbed *= f32::beerLambert(kSigma[crossing.from] * t);
        p += t * d;
        volumes = crossing.transmitted;
        if (crossing.from == crossing.to) return;
        const f32::Interface boundary = f32::meetInterface(d, entering ? out : -out, kIor[crossing.to] / kIor[crossing.from]);
        REQUIRE_FALSE(boundary.totalReflection);
        transmittance *= 1 - double(boundary.reflectance);
        d = boundary.refracted;
    }
};

double sum(const Way& way) {
    return 0.7 * way.lengths[1] + 0.4 * way.lengths[2] + 0.2 * way.lengths[3];
}

Way throughSlabs(double degrees) {
    constexpr float kPlanes[] = {0, -0.2f, -0.7f, -1.1f, -1.6f, -1.8f};
    constexpr glm::uint kMedium[] = {1, 2, 3, 3, 2, 1};
    const double a = degrees * kPi / 180;
    Way way{vec3(0, 0, 1), vec3(float(std::sin(a)), 0, -float(std::cos(a)))};
    for (int i = 0; i < 6; ++i) way.cross((kPlanes[i] - way.p.z) / way.d.z, kMedium[i], vec3(0, 0, i < 3 ? 1 : -1));
    return way;
}

/// Balls of radius 1, .9 and .5 about the origin, as the shader meets spheres.
Way throughBalls(float b, int& interfaces) {
    constexpr float kRadius[] = {1, 0.9f, 0.5f};
    Way way{vec3(b, 0, 3), vec3(0, 0, -1)};
    for (interfaces = 0; interfaces < 20; ++interfaces) {
        int nearest = -1;
        f32::SphereHit best{false, 1e30f};
        for (int i = 0; i < 3; ++i) {
            const f32::SphereHit hit = f32::intersectSphere(way.p, way.d, vec3(0), kRadius[i], best.t);
            if (hit.hit) best = hit, nearest = i;
        }
        if (nearest < 0) break;
        const f32::SurfacePoint point = f32::spherePoint(way.p, way.d, best.t, vec3(0), kRadius[nearest]);
        way.cross(best.t, glm::uint(nearest) + 1, point.ng);
        way.p = f32::offsetRayOrigin(point.p, point.pError, point.ng, way.d);
    }
    return way;
}

}  // namespace

TEST_CASE("slabs: transmittance, lengths, lateral shift and what is absorbed") {
    for (const auto& [degrees, transmittance] :
         {std::pair{0.0, 0.916545}, std::pair{60.0, 0.823383}, std::pair{80.0, 0.370996}}) {
        CAPTURE(degrees);
        const Way way = throughSlabs(degrees);
        CHECK(std::abs(way.transmittance - transmittance) < 1e-5);
        CHECK(std::abs(double(way.absorbed) - std::exp(-sum(way))) < 1e-6);
        CHECK(std::abs(glm::dot(way.d, vec3(0, 0, -1)) - std::cos(degrees * kPi / 180)) < 1e-6);
    }
    const Way steep = throughSlabs(60);
    const double expected[] = {0.489898, 1.296945, 0.533114};
    for (int i = 0; i < 3; ++i) CHECK(std::abs(steep.lengths[i + 1] - expected[i]) < 1e-5);
    CHECK(std::abs(double(steep.p.x) - std::tan(kPi / 3) - 1.461151) < 1e-5);  // sideways from the first plane to the last
}

TEST_CASE("concentric balls: deviation, lengths, transmittance") {
    int interfaces = 0;
    const Way inner = throughBalls(0.3f, interfaces);
    CHECK(interfaces == 6);
    CHECK(std::abs(std::asin(-double(inner.d.x)) - 6.984927 * kPi / 180) < 1e-5);
    CHECK(std::abs(inner.lengths[1] - 0.204599) < 1e-5);
    CHECK(std::abs(inner.lengths[2] - 0.847677) < 1e-5);
    CHECK(std::abs(inner.lengths[3] - 0.888944) < 1e-5);
    CHECK(std::abs(inner.transmittance - 0.916201) < 1e-5);
    const Way outer = throughBalls(0.7f, interfaces);
    CHECK(interfaces == 4);
    CHECK(std::abs(std::asin(-double(outer.d.x)) - 25.918576 * kPi / 180) < 1e-5);
    CHECK(std::abs(outer.lengths[1] - 0.229747) < 1e-5);
    CHECK(std::abs(outer.lengths[2] - 1.476588) < 1e-5);
    CHECK(std::abs(outer.transmittance - 0.898168) < 1e-5);
}
