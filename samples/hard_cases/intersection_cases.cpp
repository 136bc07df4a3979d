// Rays that a mesh must stop: small, far, thin triangles, and those that are aimed at where triangles meet.
#include <cmath>

#include "cases.hpp"
#include "wall.hpp"

namespace hard_cases {
namespace {

/// A black wall before white, or before a white square of `floor` metres: percent of the pixels that see through.
double seenThrough(Stage& stage, const View& view, const std::string& obj, const Pose& pose, double floor = 0) {
    stage.write("wall.obj", obj);
    Shot shot;
    shot.view = view;
    shot.background = 1;
    shot.materials["black"] = {{"model", "phong"}, {"diffuse", 0}};
    shot.objects = {meshOf("wall.obj", "black")};
    if (pose.center != dvec3(0)) shot.objects.push_back(counterweight(pose, "black"));
    shot.materials["white"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}};
    const dvec3 corner = pose.point(-floor / 2, -floor / 2, -floor / 100);
    if (floor > 0) shot.objects.push_back(rectangle(corner, floor * pose.right, floor * pose.up, "white"));
    const Picture picture = stage.render(shot);
    return percentOf(picture, [&](uint32_t x, uint32_t y) { return picture.at(x, y) > 0.5; });
}

/// Triangles with legs of `edge` metres, at `distance` from the middle of the scene.
double missingFaces(Stage& stage, double edge, double distance) {
    const Pose pose = tilted(distance * dvec3(0.6, -0.64, 0.48));
    const Grid grid{44, 44, edge, edge, 0, 0};
    return seenThrough(stage, across(pose, 50 * edge, 38 * edge, 64), wall(pose, grid), pose);
}

constexpr uint32_t kAimed = 128;

/// Every ray goes through a point of the grid: (x, y) cells off its vertices.
double aimedRays(Stage& stage, double x, double y, double distance) {
    const Pose pose = tilted(distance * dvec3(0.6, -0.64, 0.48));
    constexpr double kCell = 0.1;
    // An odd number of cells has no vertex in the middle, nor has an even number of pixels a centre there.
    const Grid grid{kAimed + 5, kAimed + 5, kCell, kCell, x * kCell, y * kCell};
    return seenThrough(stage, across(pose, kAimed * kCell, kAimed * kCell, kAimed), wall(pose, grid), pose);
}

double tinyAndHuge(Stage& stage) {
    const Pose pose = tilted(dvec3(0));
    const Grid grid{44, 44, 0.002, 0.002, 0, 0};
    return seenThrough(stage, across(pose, 0.1, 0.08, 64), wall(pose, grid), pose, 1e4);
}

double needles(Stage& stage) {
    const Pose pose = tilted(dvec3(0));
    const Grid grid{10000, 1, 1e-4, 1, 0, 0};
    return seenThrough(stage, across(pose, 1, 0.9, 64), wall(pose, grid), pose);
}

/// Rays in the planes in which the boxes of the hierarchy end: the middle column and row of an odd picture.
double raysInPlanes(Stage& stage) {
    const Pose pose;
    const Grid grid{16, 16, 0.25, 0.25, 0, 0};
    return seenThrough(stage, across(pose, 4, 3.5, 129), wall(pose, grid), pose);
}

/// Triangles that double in size: no grid of boxes suits all. White squares over one another, the camera above the smallest.
double doublingSizes(Stage& stage) {
    constexpr int kLevels = 48;
    Shot shot;
    shot.view = {{0.3, 0.2, 1}, {0.3, 0.2, 0}, 90, 64};
    shot.materials["white"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}};
    for (int i = 0; i < kLevels; ++i) {
        const double size = std::ldexp(1.0, i - kLevels / 2);
        shot.objects.push_back(rectangle(size * dvec3(-1, -1, -1e-3), {2 * size, 0, 0}, {0, 2 * size, 0}, "white"));
    }
    const Picture picture = stage.render(shot);
    const minirt_stats& s = picture.stats;
    const double lost = static_cast<double>(s.traversal_cap + s.segment_overflow + s.volume_overflow + s.nan_pixels);
    return lost + percentOf(picture, [&](uint32_t x, uint32_t y) { return picture.at(x, y) != 1; });
}

}  // namespace

std::vector<HardCase> intersectionCases() {
    const std::string through = "% of rays that go through a wall";
    return {
        {"small faces", "triangles with legs of 2 cm", through, 0, [](Stage& s) { return missingFaces(s, 0.02, 0); }},
        {"smaller faces", "triangles with legs of 5 mm", through, 0, [](Stage& s) { return missingFaces(s, 0.005, 0); }},
        {"small and far faces", "triangles with legs of 5 cm, 1 km from the middle of the scene", through, 0,
         [](Stage& s) { return missingFaces(s, 0.05, 1e3); }},
        {"vertices", "rays aimed at shared vertices", through, 0, [](Stage& s) { return aimedRays(s, 0, 0, 0); }},
        {"edges", "rays aimed at shared edges", through, 0, [](Stage& s) { return aimedRays(s, 0, 0.3, 0); }},
        {"diagonals", "rays aimed at shared diagonals", through, 0, [](Stage& s) { return aimedRays(s, 0.3, 0.3, 0); }},
        {"vertices far away", "rays aimed at shared vertices, 1 km from the middle of the scene", through, 0,
         [](Stage& s) { return aimedRays(s, 0, 0, 1e3); }},
        {"edges far away", "rays aimed at shared edges, 1 km from the middle of the scene", through, 0,
         [](Stage& s) { return aimedRays(s, 0, 0.3, 1e3); }},
        {"tiny and huge", "triangles with legs of 2 mm before a floor of 10 km", through, 0, tinyAndHuge},
        {"needles", "triangles of 1 m by 0.1 mm", through, 0, needles},
        {"rays in planes", "rays along an axis in the planes that bound the boxes of the hierarchy", through, 0, raysInPlanes},
        {"doubling sizes", "squares that double in size 48 times", "lost rays and % of wrong pixels", 0, doublingSizes},
    };
}

}  // namespace hard_cases
