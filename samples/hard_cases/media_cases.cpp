// What light meets inside of bodies: their medium, and other bodies.
#include <cmath>
#include <cstdio>

#include "cases.hpp"
#include "wall.hpp"

namespace hard_cases {
namespace {

Json ball(const dvec3& center, double radius, const std::string& material) {
    return {{"sphere", {{"center", at(center)}, {"radius", radius}}}, {"material", material}};
}

/// A ball of index 1 that takes half of the light in 1 m, before white: Beer's and Lambert's law along each ray.
double absorption(Stage& stage) {
    Shot shot;
    shot.view = {{0, 0, 5}, {0, 0, 0}, 30, 64};
    shot.background = 1;
    shot.materials["grey"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1}};
    shot.materials["grey"]["attenuationColor"] = {0.5, 0.5, 0.5};
    shot.objects = {ball(dvec3(0), 1, "grey")};
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        const double length = chordOf(shot.view, x, y, 1);
        const bool rim = length > 0 && length < 0.1;  // where the length changes without bound
        return rim ? 0.0 : std::abs(picture.at(x, y) - std::pow(0.5, length));
    });
}

/// Balls of other glass within a ball that displaces them: their surfaces are hidden, and the picture that of the ball alone.
double hiddenSurfaces(Stage& stage) {
    Shot shot;
    shot.view = {{0, 1, 5}, {0, 0, 0}, 30, 64};
    shot.background = 0.2;
    shot.materials["light"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}};
    shot.materials["glass"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1.5}};
    shot.materials["hidden"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1.2}};
    shot.objects = {rectangle({-20, -1.5, -20}, {0, 0, 40}, {40, 0, 0}, "light"), ball(dvec3(0), 1, "glass")};
    shot.objects[1]["priority"] = 1;
    const Picture plain = stage.render(shot);
    shot.objects.push_back(ball({0.1, 0.05, 0}, 0.8, "hidden"));
    shot.objects.push_back(ball({-0.2, 0.1, 0.1}, 0.6, "hidden"));
    const Picture filled = stage.render(shot);
    return percentOf(filled, [&](uint32_t x, uint32_t y) { return std::abs(filled.at(x, y) - plain.at(x, y)) > 1e-4; });
}

/// Snell's law for a unit direction and a normal against it.
dvec3 refracted(const dvec3& d, const dvec3& n, double eta) {
    const double cosI = -glm::dot(d, n);
    return (d + n * cosI) / eta - n * std::sqrt(1 - (1 - cosI * cosI) / (eta * eta));
}

/// A wedge of glass: its front in z = 0, its back leaning away from the top.
struct Wedge {
    double lean = glm::radians(15.0);

    std::string obj() const {
        const double bottom = -0.1 - 2 * std::tan(lean);
        char text[512];
        std::snprintf(text, sizeof text,
                      "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nv -2 -1 %.17g\nv 2 -1 %.17g\nv -2 1 -0.1\nv 2 1 -0.1\n"
                      "f 1 2 3 4\nf 5 7 8 6\nf 1 5 6 2\nf 4 3 8 7\nf 1 4 7 5\nf 2 6 8 3\n",
                      bottom, bottom);
        return text;
    }
    /// Where a ray through it meets the plane z.
    dvec3 landing(const dvec3& origin, const dvec3& d, double index, double z) const {
        const dvec3 back(0, std::sin(lean), -std::cos(lean));
        const dvec3 inside = refracted(d, {0, 0, 1}, index);
        const dvec3 in = origin + d * (-origin.z / d.z);
        const dvec3 out = in + inside * (glm::dot(dvec3(0, 1, -0.1) - in, back) / glm::dot(inside, back));
        const dvec3 outside = refracted(inside, -back, 1 / index);
        return out + outside * ((z - out.z) / outside.z);
    }
};

/// The edge of a light 20 m behind a wedge, by the index of each channel (KHR_materials_dispersion): the largest angle from it at which a channel is on
/// the wrong side.
double dispersion(Stage& stage) {
    constexpr double kIndex = 1.7;
    constexpr double kHalfSpread = (kIndex - 1) * 0.025;
    constexpr double kPlane = -20;
    const Wedge wedge;
    stage.write("wedge.obj", wedge.obj());
    Shot shot;
    shot.view = {{0, 0, 3}, {0, 0, 0}, 4, 128};
    shot.maxDepth = 2;  // in and out
    const double edge = wedge.landing(shot.view.position, {0, 0, -1}, kIndex, kPlane).y;
    shot.materials["light"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}, {"doubleSided", true}};
    shot.materials["flint"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", kIndex}, {"dispersion", 1}};
    shot.objects = {meshOf("wedge.obj", "flint"), rectangle({-50, edge, kPlane}, {100, 0, 0}, {0, 50, 0}, "light")};
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        double worst = 0;
        for (int channel = 0; channel < 3; ++channel) {
            const double index = kIndex + (channel - 1) * kHalfSpread;
            const double above = wedge.landing(shot.view.position, shot.view.direction(x, y), index, kPlane).y - edge;
            if ((above > 0) != (picture.at(x, y, channel) > 0.1)) worst = std::max(worst, std::abs(above / kPlane));
        }
        return worst;
    });
}

}  // namespace

std::vector<HardCase> mediaCases() {
    return {
        {"absorption", "a ball that takes half of the light in 1 m", "error", 1e-5, absorption},
        {"dispersion", "red, green and blue through a wedge of index 1.7, as three channels", "radians that a channel is off by",
         1e-6, dispersion},
        {"hidden surfaces", "balls within a ball that displaces them, against the ball alone", "% of pixels that differ", 0,
         hiddenSurfaces},
    };
}

}  // namespace hard_cases
