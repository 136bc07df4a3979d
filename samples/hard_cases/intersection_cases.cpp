// Rays that a mesh must stop: small, far, thin triangles, and those that are aimed at where triangles meet.
#include <cmath>
#include <cstdio>

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

/// Faces without area along every edge of the grid, twice the same corner or three in a row: their neighbours are still hit.
double besideDegenerates(Stage& stage, double x, double y) {
    const Pose pose = tilted(dvec3(0));
    constexpr double kCell = 0.1;
    constexpr int kSide = kAimed + 5;
    std::string obj = wall(pose, {kSide, kSide, kCell, kCell, x * kCell, y * kCell});
    char line[96];
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i + 2 <= kSide; ++i) {
            const int a = j * (kSide + 1) + i + 1;
            std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", a, a, a + 1, a, a + 1, a + 2);
            obj += line;
        }
    return seenThrough(stage, across(pose, kAimed * kCell, kAimed * kCell, kAimed), obj, pose);
}

/// The same wall with vertices that are off its plane, and faces that are no larger, by less than a normal float holds.
double denormals(Stage& stage) {
    const Pose pose;
    constexpr double kTiny = 1e-41;
    constexpr int kSide = 33;
    constexpr int kMiddle = kSide / 2;
    std::string obj;
    char line[160];
    for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i) {
            std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\nv %.17g %.17g %.17g\n", 0.1 * (i - kMiddle),
                          0.1 * (j - kMiddle), kTiny * (i % 3 - 1), i * kTiny, j * kTiny, -kTiny);
            obj += line;
        }
    const auto vertex = [](int i, int j, int tiny) { return 2 * (j * (kSide + 1) + i) + 1 + tiny; };
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            for (const int tiny : {0, 1}) {
                std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", vertex(i, j, tiny), vertex(i + 1, j, tiny),
                              vertex(i + 1, j + 1, tiny), vertex(i, j, tiny), vertex(i + 1, j + 1, tiny), vertex(i, j + 1, tiny));
                obj += line;
            }
    return seenThrough(stage, across(pose, 3, 3, 65), obj, pose);
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
double raysInPlanes(Stage& stage, double distance) {
    Pose pose;
    pose.center = distance * dvec3(1, -1, 1);
    const Grid grid{16, 16, 0.25, 0.25, 0, 0};
    return seenThrough(stage, across(pose, 4, 3.5, 129), wall(pose, grid), pose);
}

/// White squares around one centre, the first of them `first` metres wide and each by `factor` larger, `slope` of it farther away. What is lost on the way down to
/// the smallest, and percent of the pixels that are not white.
double squares(Stage& stage, int count, double first, double factor, double slope) {
    Shot shot;
    shot.view = {{0.3, 0.2, 1}, {0.3, 0.2, 0}, 90, 64};
    shot.materials["white"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}};
    double size = first;
    for (int i = 0; i < count; ++i, size *= factor)
        shot.objects.push_back(rectangle(size * dvec3(-1, -1, -slope), {2 * size, 0, 0}, {0, 2 * size, 0}, "white"));
    const Picture picture = stage.render(shot);
    const minirt_stats& s = picture.stats;
    const double lost = static_cast<double>(s.traversal_cap + s.segment_overflow + s.volume_overflow + s.nan_pixels);
    return lost + percentOf(picture, [&](uint32_t x, uint32_t y) { return picture.at(x, y) != 1; });
}

}  // namespace

std::vector<HardCase> intersectionCases() {
    const std::string through = "% of rays that go through a wall";
    const std::string lost = "lost rays and % of wrong pixels";
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
        {"rays in planes", "rays along an axis in the planes that bound the boxes of the hierarchy", through, 0,
         [](Stage& s) { return raysInPlanes(s, 0); }},
        {"rays in planes far away", "the same 100 km from the middle of the scene along each axis", through, 0,
         [](Stage& s) { return raysInPlanes(s, 1e5); }},
        {"beside degenerates", "rays aimed at edges along which faces without area lie", through, 0,
         [](Stage& s) { return besideDegenerates(s, 0, 0.3) + besideDegenerates(s, 0.3, 0); }},
        {"at degenerates", "rays aimed at vertices that faces without area share", through, 0,
         [](Stage& s) { return besideDegenerates(s, 0, 0); }},
        {"denormals", "coordinates and faces too small for a normal float", through, 0, denormals},
        {"doubling sizes", "squares that double in size 48 times", lost, 0,
         [](Stage& s) { return squares(s, 48, std::ldexp(1.0, -24), 2, 1e-3); }},
        {"one centre", "2000 squares in one plane around one centre, which no plane parts", lost, 0,
         [](Stage& s) { return squares(s, 2000, 1e-3, 1.01, 0); }},
    };
}

}  // namespace hard_cases
