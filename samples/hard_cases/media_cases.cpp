// What light meets inside of bodies: their medium, and other bodies.
#include <cmath>

#include "cases.hpp"
#include "wall.hpp"

namespace hard_cases {
namespace {

Json ball(const dvec3& center, double radius, const std::string& material) {
    return {{"sphere", {{"center", at(center)}, {"radius", radius}}}, {"material", material}};
}

/// The length of a ray from the camera within a ball around 0; 0 where it misses.
double chord(const View& view, uint32_t x, uint32_t y, double radius) {
    const dvec3 d = view.direction(x, y);
    const double nearest = glm::length(view.position - glm::dot(view.position, d) * d);
    return nearest < radius ? 2 * std::sqrt(radius * radius - nearest * nearest) : 0;
}

/// A ball of index 1 that takes half of the light in 1 m, before white: Beer's and Lambert's law along each ray.
double absorption(const Stage& stage) {
    Shot shot;
    shot.view = {{0, 0, 5}, {0, 0, 0}, 30, 64};
    shot.background = 1;
    shot.materials["grey"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1}};
    shot.materials["grey"]["attenuationColor"] = {0.5, 0.5, 0.5};
    shot.objects = {ball(dvec3(0), 1, "grey")};
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        const double length = chord(shot.view, x, y, 1);
        const bool rim = length > 0 && length < 0.1;  // where the length changes without bound
        return rim ? 0.0 : std::abs(picture.at(x, y) - std::pow(0.5, length));
    });
}

/// Balls of other glass within a ball that displaces them: their surfaces are hidden, and the picture that of the ball alone.
double hiddenSurfaces(const Stage& stage) {
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

}  // namespace

std::vector<HardCase> mediaCases() {
    return {
        {"absorption", "a ball that takes half of the light in 1 m", "error", 1e-5, absorption},
        {"hidden surfaces", "balls within a ball that displaces them, against the ball alone", "% of pixels that differ", 0,
         hiddenSurfaces},
    };
}

}  // namespace hard_cases
