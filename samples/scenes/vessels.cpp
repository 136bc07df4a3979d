#include "vessels.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "lathe.hpp"

namespace samples {
namespace {

constexpr int kSegments = 96;
constexpr double kCreaseDegrees = 35;

double innerRadius(const Tumbler& shape, double y) {
    return glm::mix(shape.bottomRadius, shape.topRadius, y / shape.height) - shape.wall;
}

/// 0 at the ends of [lo, hi], 1 in the middle, with a continuous slope.
double bump(double lo, double hi, double x) {
    const double t = glm::clamp((x - lo) / (hi - lo), 0.0, 1.0);
    return glm::smoothstep(0.0, 0.3, t) * glm::smoothstep(0.0, 0.3, 1 - t);
}

/// Presses grooves into the outer wall; the inside keeps its shape.
void flute(Mesh& mesh, const Tumbler& shape) {
    for (glm::dvec3& p : mesh.positions) {
        const double radius = std::hypot(p.x, p.z);
        if (radius < innerRadius(shape, p.y) + shape.wall / 2) continue;
        const double groove = 0.5 - 0.5 * std::cos(shape.flutes * std::atan2(p.z, p.x));
        const double pressed = shape.fluteDepth * groove * bump(0.05 * shape.height, 0.62 * shape.height, p.y);
        p.x *= 1 - pressed / radius;
        p.z *= 1 - pressed / radius;
    }
}

Mesh turned(const Profile& profile, int segments = kSegments) {
    Mesh mesh = lathe(profile, segments);
    mesh.uvs.clear();
    for (Face& face : mesh.faces) {
        for (Corner& corner : face) corner.uv = kNone;
    }
    return mesh;
}

}  // namespace

Mesh tumbler(const Tumbler& shape) {
    const double lip = 0.49 * shape.wall;
    const Profile profile = rounded({{0, 0},
                                     {shape.bottomRadius, 0, 0.003},
                                     {shape.topRadius, shape.height, lip},
                                     {shape.topRadius - shape.wall, shape.height, lip},
                                     {innerRadius(shape, shape.base), shape.base, shape.innerFillet},
                                     {0, shape.base}});
    Mesh mesh = turned(shape.flutes > 0 ? subdivided(profile, 0.004) : profile, shape.flutes > 0 ? 12 * shape.flutes : kSegments);
    if (shape.flutes > 0) flute(mesh, shape);
    addNormals(mesh, kCreaseDegrees);
    return mesh;
}

Mesh tumblerFilling(const Tumbler& shape, double level, double overlap) {
    constexpr double kClimb = 0.0012;
    constexpr double kReach = 0.0015;
    constexpr int kSteps = 10;
    const double bottom = shape.base - overlap;
    const double wall = innerRadius(shape, level + kClimb) + overlap;
    Profile profile = rounded(
        {{0, bottom}, {innerRadius(shape, shape.base) + overlap, bottom, shape.innerFillet + overlap}, {wall, level + kClimb}});
    for (int i = 1; i <= kSteps; ++i) {
        const double inward = 5 * kReach * i / kSteps;
        profile.push_back({wall - inward, level + kClimb * std::exp(-inward / kReach)});
    }
    profile.push_back({0, profile.back().y});
    Mesh mesh = turned(profile);
    addNormals(mesh, kCreaseDegrees);
    return mesh;
}

Mesh wineGlass() {
    constexpr double kWall = 0.0014;
    const Profile outside = spline({{0.0042, 0.010},
                                    {0.0036, 0.030},
                                    {0.0036, 0.070},
                                    {0.0060, 0.086},
                                    {0.0240, 0.102},
                                    {0.0385, 0.128},
                                    {0.0400, 0.150},
                                    {0.0360, 0.182},
                                    {0.0315, 0.206}},
                                   6);
    const Profile inside = spline({{0.0315 - kWall, 0.206},
                                   {0.0360 - kWall, 0.182},
                                   {0.0400 - kWall, 0.150},
                                   {0.0385 - kWall, 0.1285},
                                   {0.0232, 0.1036},
                                   {0.0080, 0.0925},
                                   {0, 0.0910}},
                                  6);
    Profile profile = rounded({{0, 0}, {0.034, 0, 0.0008}, {0.034, 0.0020, 0.0008}, {0.012, 0.0042, 0.004}, {0.0042, 0.010}});
    profile.insert(profile.end(), outside.begin() + 1, outside.end());
    profile.push_back({0.0315 - kWall / 2, 0.2065});
    profile.insert(profile.end(), inside.begin(), inside.end());
    Mesh mesh = turned(profile);
    addNormals(mesh, 60);
    return mesh;
}

Mesh bowl() {
    const Profile outside = spline({{0.030, 0.006}, {0.046, 0.014}, {0.064, 0.036}, {0.074, 0.064}}, 8);
    const Profile inside = spline({{0.070, 0.064}, {0.060, 0.038}, {0.043, 0.018}, {0.024, 0.0105}, {0, 0.0095}}, 8);
    Profile profile = rounded({{0, 0.002}, {0.022, 0.002, 0.001}, {0.024, 0, 0.001}, {0.029, 0, 0.001}, {0.030, 0.006}});
    profile.insert(profile.end(), outside.begin() + 1, outside.end());
    profile.push_back({0.0733, 0.0656});
    profile.push_back({0.072, 0.0662});
    profile.push_back({0.0707, 0.0656});
    profile.insert(profile.end(), inside.begin(), inside.end());
    Mesh mesh = turned(profile);
    addNormals(mesh, 45);
    return mesh;
}

Mesh vase() {
    const Profile side = spline({{0.030, 0.004},
                                 {0.046, 0.040},
                                 {0.058, 0.085},
                                 {0.052, 0.130},
                                 {0.028, 0.165},
                                 {0.019, 0.190},
                                 {0.022, 0.212},
                                 {0.031, 0.222}},
                                8);
    const Profile neck =
        spline({{0.0275, 0.2215}, {0.0190, 0.211}, {0.0160, 0.190}, {0.0240, 0.165}, {0.030, 0.140}, {0, 0.120}}, 6);
    Profile profile = rounded({{0, 0}, {0.0295, 0, 0.001}, {0.030, 0.004}});
    profile.insert(profile.end(), side.begin() + 1, side.end());
    profile.push_back({0.0298, 0.2236});
    profile.insert(profile.end(), neck.begin(), neck.end());
    Mesh mesh = lathe(profile, kSegments);
    addNormals(mesh, 50);
    return mesh;
}

}  // namespace samples
