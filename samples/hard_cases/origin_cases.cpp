// Where rays start that leave a surface: not so near that they meet it again, not so far that they pass over the next.
#include <cmath>
#include <cstdio>
#include <random>

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

/// A triangle for each pixel, somewhere between `near` and `far` metres away and as large as it has to be, in any attitude but edge-on, before a light; another
/// light in the camera. Percent of pixels that see through or, where shadows are `judged`, are in their own.
double triangles(Stage& stage, double near, double far, bool judged) {
    Shot shot;
    shot.view = {dvec3(0), {0, 0, -1}, 40, 64};
    std::mt19937 random(1);
    const auto uniform = [&] { return random() / 4294967296.0; };
    std::string obj;
    std::string faces;
    char line[160];
    int vertices = 0;
    for (uint32_t y = 0; y < shot.view.size; ++y)
        for (uint32_t x = 0; x < shot.view.size; ++x) {
            const dvec3 d = shot.view.direction(x, y);
            const double distance = near * std::pow(far / near, uniform());
            const dvec3 tilt = dvec3{uniform(), uniform(), uniform()} * 2.0 - 1.0;
            const dvec3 normal = glm::normalize(-d + 0.9 * tilt / std::max(glm::length(tilt), 1e-3));
            const dvec3 right = glm::normalize(glm::cross(normal, dvec3(0.3, 1, 0.2)));
            const dvec3 up = glm::cross(normal, right);
            for (int corner = 0; corner < 3; ++corner) {
                const double angle = glm::radians(120.0 * corner + 40 * uniform());
                const dvec3 p = distance * (d + 2e-3 * (std::cos(angle) * right + std::sin(angle) * up));
                std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
                obj += line;
            }
            std::snprintf(line, sizeof line, "f %d %d %d\n", vertices + 1, vertices + 2, vertices + 3);
            faces += line;
            vertices += 3;
        }
    stage.write("triangles.obj", obj + faces);
    shot.materials["white"] = {{"model", "phong"}};
    shot.materials["light"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {9, 9, 9}}, {"doubleSided", true}};
    shot.objects = {meshOf("triangles.obj", "white")};
    for (const double side : {-2 * far, 2 * far})  // the camera is the middle of it all
        shot.objects.push_back(rectangle({-2 * far, -2 * far, side}, {4 * far, 0, 0}, {0, 4 * far, 0}, "light"));
    shot.lights = Json::array({{{"type", "point"}, {"position", {0, 0, 0}}, {"intensity", {1, 1, 1}}, {"falloff", "none"}}});
    const Picture picture = stage.render(shot);
    return percentOf(picture,
                     [&](uint32_t x, uint32_t y) { return picture.at(x, y) > 8 || (judged && !(picture.at(x, y) > 0)); });
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

/// A block of glass of the shaft's walls, closed behind its ends: within 40 degrees of its axis all light is reflected.
std::string lightGuide(double length) {
    std::string obj;
    char line[64];
    for (int i = 0; i < 8; ++i) {
        std::snprintf(line, sizeof line, "v %g %g %g\n", i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 1 : -length - 1);
        obj += line;
    }
    return obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// A shaft with mirrors for walls, or within glass, a chequered light at its end: the straight ray through the unfolded shaft says where each ray ends. The
/// largest distance from the edge of a cell at which the colour is wrong, in metres.
double shaft(Stage& stage, bool glass) {
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
    shot.materials["glass"] = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1.5}};
    if (glass) {
        stage.write("guide.obj", lightGuide(kLength));
        shot.objects.push_back(meshOf("guide.obj", "glass"));
    }
    for (const double side : {-0.5, 0.5}) {
        if (glass) break;
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
    const std::string off = "m that a ray is off by";
    const std::string missed = "% of rays that miss the second sheet";
    return {
        {"own shadow", "a lit wall 1 km from the middle of the scene, seen from 10 m", shadow, 0,
         [](Stage& s) { return ownShadow(s, 1e3); }},
        {"own shadow far away", "a lit wall 100 km from the middle of the scene", shadow, 0,
         [](Stage& s) { return ownShadow(s, 1e5); }},
        {"own shadow farther away", "a lit wall 1000 km from the middle of the scene", shadow, 0,
         [](Stage& s) { return ownShadow(s, 1e6); }},
        {"second sheet", "two sheets 0.1 mm apart, seen from 10 m", missed, 0, [](Stage& s) { return secondSheet(s, 1e-4, 0); }},
        {"second sheet far away", "two sheets 2 mm apart, 1 km from the middle of the scene", missed, 0,
         [](Stage& s) { return secondSheet(s, 2e-3, 1e3); }},
        // 1.1e-5 for 64 bounces of unit cubes, and as much again for what the camera's own rounding makes of 84 m.
        {"mirror shaft", "up to 107 reflections on the way through 64 m of a shaft", off, 2.2e-5,
         [](Stage& s) { return shaft(s, false); }},
        {"light guide", "as many total reflections on the way through 64 m of glass", off, 2.2e-5,
         [](Stage& s) { return shaft(s, true); }},
        {"tiny coordinates", "a lit triangle for each pixel, 1e-8 to 1e-7 m away", shadow, 0,
         [](Stage& s) { return triangles(s, 1e-8, 1e-7, true); }},
        {"huge coordinates", "a lit triangle for each pixel, 1e7 to 1e8 m away", shadow, 0,
         [](Stage& s) { return triangles(s, 1e7, 1e8, true); }},
        // Rays from the farthest to the light pass the nearest by less than their direction's rounding: shadows are not judged.
        {"all scales", "a triangle for each pixel, 1e-8 to 1e8 m away in one scene", "% of rays that miss it", 0,
         [](Stage& s) { return triangles(s, 1e-8, 1e8, false); }},
    };
}

}  // namespace hard_cases
