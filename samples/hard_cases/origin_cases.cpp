// Where rays start that leave a surface: not so near that they meet it again, not so far that they pass over the next.
#include <cmath>

#include "cases.hpp"
#include "wall.hpp"

namespace hard_cases {
namespace {

/// A wall of 20 m under a light, seen from 10 m: percent of its pixels that are in their own shadow.
double ownShadow(Stage& stage, double distance) {
    const Pose pose = tilted(distance * dvec3(0.6, -0.64, 0.48));
    stage.write("wall.obj", wall(pose, {3, 3, 7, 7, 0, 0}));
    Shot shot;
    shot.view = across(pose, 10, 5, 64);
    shot.materials["white"] = {{"model", "phong"}};
    shot.objects = {meshOf("wall.obj", "white"), counterweight(pose, "white")};
    const dvec3 light = -(0.5 * pose.right + 0.3 * pose.up + pose.back);
    shot.lights = Json::array({{{"type", "directional"}, {"direction", at(light)}}});
    const Picture picture = stage.render(shot);
    return percentOf(picture, [&](uint32_t x, uint32_t y) { return !(picture.at(x, y) > 0); });
}

/// A clear sheet with a shining one behind it, before black: percent of the pixels that miss the second.
double secondSheet(Stage& stage, double gap, double distance) {
    const Pose pose = tilted(distance * dvec3(0.6, -0.64, 0.48));
    Pose behind = pose;
    behind.center = pose.point(0, 0, -gap);
    stage.write("front.obj", wall(pose, {1, 1, 20, 20, 0, 0}));
    stage.write("back.obj", wall(behind, {1, 1, 20, 20, 3, 2}));
    Shot shot;
    shot.view = across(pose, 10, 5, 64);
    shot.materials["clear"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1}, {"thin", true}};
    shot.materials["light"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}, {"doubleSided", true}};
    shot.objects = {meshOf("front.obj", "clear"), meshOf("back.obj", "light"), counterweight(pose, "light")};
    const Picture picture = stage.render(shot);
    return percentOf(picture, [&](uint32_t x, uint32_t y) { return picture.at(x, y) < 0.5; });
}

/// x folded into -1/2..1/2 by mirrors there.
double folded(double x) {
    const double turn = x + 0.5 - 2 * std::floor((x + 0.5) / 2);
    return (turn <= 1 ? turn : 2 - turn) - 0.5;
}

/// A shaft with mirrors for walls, a chequered light at its end: the straight ray through the unfolded shaft says where each ray ends. The largest distance
/// from the edge of a cell at which the colour is wrong, in metres.
double mirrorShaft(Stage& stage) {
    constexpr double kLength = 64;
    constexpr double kCell = 0.25;
    Shot shot;
    shot.view = {{0.0131, 0.0217, 0}, {0.0131, 0.0217, -1}, 80, 128};
    shot.maxDepth = 255;
    shot.materials["mirror"] = {{"model", "phong"}, {"diffuse", 0}, {"reflect", 1}};
    for (const char* name : {"black", "white"})
        shot.materials[name] = {
            {"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", at(dvec3(name[0] == 'w' ? 1 : 0))}, {"doubleSided", true}};
    shot.materials["checker"] = {{"model", "checker"}, {"a", "white"}, {"b", "black"}, {"scale", kCell}};
    const dvec3 along(0, 0, -kLength - 1);
    for (const double side : {-0.5, 0.5}) {
        shot.objects.push_back(rectangle({side, -0.5, 1}, along, {0, 1, 0}, "mirror"));
        shot.objects.push_back(rectangle({-0.5, side, 1}, along, {1, 0, 0}, "mirror"));
    }
    shot.objects.push_back(rectangle({-0.5, -0.5, -kLength}, {1, 0, 0}, {0, 1, 0}, "checker"));
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        const dvec3 d = shot.view.direction(x, y);
        const dvec3 end = shot.view.position + d * (kLength / -d.z);
        const double u = folded(end.x) / kCell;
        const double v = folded(end.y) / kCell;
        const bool white = std::fmod(std::floor(u) + std::floor(v), 2.0) == 0;
        const double edge = std::min(std::abs(u - std::round(u)), std::abs(v - std::round(v))) * kCell;
        return white == (picture.at(x, y) > 0.5) ? 0.0 : edge;
    });
}

}  // namespace

std::vector<HardCase> originCases() {
    const std::string shadow = "% of pixels in their own shadow";
    const std::string missed = "% of rays that miss the second sheet";
    return {
        {"own shadow", "a lit wall 1 km from the middle of the scene, seen from 10 m", shadow, 0,
         [](Stage& s) { return ownShadow(s, 1e3); }},
        {"own shadow far away", "a lit wall 100 km from the middle of the scene", shadow, 0, [](Stage& s) { return ownShadow(s, 1e5); }},
        {"own shadow farther away", "a lit wall 1000 km from the middle of the scene", shadow, 0, [](Stage& s) { return ownShadow(s, 1e6); }},
        {"second sheet", "two sheets 0.1 mm apart, seen from 10 m", missed, 0,
         [](Stage& s) { return secondSheet(s, 1e-4, 0); }},
        {"second sheet far away", "two sheets 2 mm apart, 1 km from the middle of the scene", missed, 0,
         [](Stage& s) { return secondSheet(s, 2e-3, 1e3); }},
        // 1.1e-5 for 64 bounces of unit cubes, and as much again for what the camera's own rounding makes of 84 m.
        {"mirror shaft", "up to 107 reflections on the way through 64 m of a shaft", "m that a ray is off by", 2.2e-5,
         mirrorShaft},
    };
}

}  // namespace hard_cases
