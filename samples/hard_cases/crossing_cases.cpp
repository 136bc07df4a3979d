// One hit at each surface that a ray crosses: none missed, none met twice, however many bodies it is in.
#include <cmath>
#include <cstdio>

#include "cases.hpp"
#include "wall.hpp"

namespace hard_cases {
namespace {

constexpr uint32_t kAimed = 128;  // rays in a row
constexpr double kCell = 0.1;     // at the distance kNear
constexpr double kNear = kAimed * kCell;

/// Of index 1, so that rays go straight on; keeps `share` of the light in 1 m.
Json absorber(double share) {
    Json material = {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", 1}};
    material["attenuationColor"] = at(dvec3(share));
    return material;
}

/// A closed body between two grids across the view, front and back, in which every ray from the camera meets the same point of a cell: (x, y) cells off its
/// vertices. The camera is `kNear` before the pose.
std::string frustum(const Pose& pose, double front, double back, double x, double y) {
    constexpr int kSide = static_cast<int>(kAimed) + 5;  // odd, as are the cells of aimed walls
    std::string text;
    char line[128];
    for (const double depth : {front, back})
        for (int j = 0; j <= kSide; ++j)
            for (int i = 0; i <= kSide; ++i) {
                const double cell = kCell * (kNear + depth) / kNear;
                const dvec3 p = pose.point((x + i - 0.5 * kSide) * cell, (y + j - 0.5 * kSide) * cell, -depth);
                std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
                text += line;
            }
    const auto vertex = [](int side, int i, int j) { return (side * (kSide + 1) + j) * (kSide + 1) + i + 1; };
    const auto quad = [&](int a, int b, int c, int d) {
        std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", a, b, c, a, c, d);
        text += line;
    };
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            quad(vertex(0, i, j), vertex(0, i + 1, j), vertex(0, i + 1, j + 1), vertex(0, i, j + 1));
            quad(vertex(1, i, j), vertex(1, i, j + 1), vertex(1, i + 1, j + 1), vertex(1, i + 1, j));
        }
    for (int i = 0; i < kSide; ++i) {
        quad(vertex(0, i + 1, 0), vertex(0, i, 0), vertex(1, i, 0), vertex(1, i + 1, 0));
        quad(vertex(0, i, kSide), vertex(0, i + 1, kSide), vertex(1, i + 1, kSide), vertex(1, i, kSide));
        quad(vertex(0, 0, i), vertex(0, 0, i + 1), vertex(1, 0, i + 1), vertex(1, 0, i));
        quad(vertex(0, kSide, i + 1), vertex(0, kSide, i), vertex(1, kSide, i), vertex(1, kSide, i + 1));
    }
    return text;
}

/// A body in a body, both of which take light, before white. A surface missed or met twice makes a ray too bright or too dark: percent of them.
double crossings(Stage& stage, double x, double y) {
    constexpr double kOuter = 0.5;
    constexpr double kInner = 0.1;
    const Pose pose = tilted(dvec3(0));
    stage.write("outer.obj", frustum(pose, 0, 1, x, y));
    stage.write("inner.obj", frustum(pose, 0.25, 0.75, x, y));
    Shot shot;
    shot.view = across(pose, kNear, kNear, kAimed);
    shot.background = 1;
    shot.materials["outer"] = absorber(kOuter);
    shot.materials["inner"] = absorber(kInner);
    shot.objects = {meshOf("outer.obj", "outer"), meshOf("inner.obj", "inner")};
    const Picture picture = stage.render(shot);
    return percentOf(picture, [&](uint32_t px, uint32_t py) {
        const double slope = 1 / -glm::dot(shot.view.direction(px, py), pose.back);
        const double expected = std::pow(kOuter * kInner, 0.5 * slope);
        return std::abs(picture.at(px, py) - expected) > 1e-2;  // far more than any length is off by
    });
}

/// Balls in balls: a ray in the middle is in all of them at once. The largest error against Beer's and Lambert's law, and all that overflowed.
double deepNest(Stage& stage) {
    constexpr int kBalls = 15;
    constexpr double kShare = 0.8;
    Shot shot;
    shot.view = {{0, 0, 5}, {0, 0, 0}, 26, 64};
    shot.background = 1;
    shot.maxDepth = 4 * kBalls;
    const auto radius = [](int i) { return 1.0 - i / 16.0; };
    const auto share = [](int i) { return i % 2 ? kShare : kShare * kShare; };
    for (int i = 0; i < kBalls; ++i) {
        const std::string name = "medium " + std::to_string(i);
        shot.materials[name] = absorber(share(i));
        shot.objects.push_back({{"sphere", {{"center", {0, 0, 0}}, {"radius", radius(i)}}}, {"material", name}});
    }
    const Picture picture = stage.render(shot);
    const auto lost = static_cast<double>(picture.stats.volume_overflow + picture.stats.segment_overflow);
    return lost + largestOf(picture, [&](uint32_t x, uint32_t y) {
               double expected = 1;
               double length = 0;  // within the balls so far, from the inside out
               for (int i = kBalls - 1; i >= 0; --i) {
                   const double chord = chordOf(shot.view, x, y, radius(i));
                   if (chord > 0 && chord < 0.2) return 0.0;  // near a rim the length changes without bound
                   expected *= std::pow(share(i), chord - length);
                   length = chord;
               }
               return std::abs(picture.at(x, y) - expected);
           });
}

}  // namespace

std::vector<HardCase> crossingCases() {
    const std::string unlike = "% of rays that do not meet each surface once";
    return {
        {"crossings at vertices", "a body in a body, rays aimed at vertices of all four surfaces", unlike, 0,
         [](Stage& s) { return crossings(s, 0, 0); }},
        {"crossings at edges", "the same bodies, rays aimed at edges of all four surfaces", unlike, 0,
         [](Stage& s) { return crossings(s, 0, 0.3); }},
        {"crossings at diagonals", "the same bodies, rays aimed at diagonals of all four surfaces", unlike, 0,
         [](Stage& s) { return crossings(s, 0.3, 0.3); }},
        {"deep nest", "15 balls, each within the one before", "error, and what overflowed", 1e-5, deepNest},
    };
}

}  // namespace hard_cases
