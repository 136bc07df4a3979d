#include "decanter.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "lathe.hpp"
#include "noise.hpp"
#include "vessels.hpp"

namespace samples {
namespace {

constexpr int kSegments = 96;
constexpr double kCreaseDegrees = 35;

// The lower part is that of a tumbler.
const Tumbler kBody{0.0495, 0.0495, 0.24, 0.003, 0.012, 0.010, 0, 0};

Mesh turned(const Profile& profile) {
    Mesh mesh = lathe(profile, kSegments);
    addNormals(mesh, kCreaseDegrees);
    return mesh;
}

/// The scratch at height v of the knob, -1 to 1, and how it wanders around it.
double scratch(double u, double v, double rows) {
    const double angle = glm::two_pi<double>() * u;
    return 2 * valueNoise({3 * std::cos(angle) + 5, rows * v, 3 * std::sin(angle) + 5}) - 1;
}

}  // namespace

Mesh decanter() {
    const double inner = kBody.bottomRadius - kBody.wall;
    return turned(rounded({{0, 0},
                           {kBody.bottomRadius, 0, 0.004},
                           {kBody.bottomRadius, 0.100, 0.030},
                           {0.0155, 0.150, 0.020},
                           {0.0155, 0.203, 0.010},
                           {0.0200, 0.215, 0.0008},
                           {0.0170, 0.2165, 0.0008},
                           {0.0125, 0.205, 0.010},
                           {0.0125, 0.1485, 0.018},
                           {inner, 0.0985, 0.028},
                           {inner, kBody.base, kBody.innerFillet},
                           {0, kBody.base}}));
}

Mesh decanterFilling() {
    return tumblerFilling(kBody, 0.076);
}

Mesh decanterStopper() {
    Profile profile = rounded({{0, 0.185},
                               {0.0110, 0.185, 0.001},
                               {0.0110, 0.2172},
                               {0.0180, 0.2172, 0.001},
                               {0.0180, 0.2215, 0.001},
                               {0.0085, 0.2235, 0.002},
                               {0.0075, 0.2275}});
    const Profile knob =
        spline({{0.0075, 0.2275}, {0.0150, 0.2335}, {0.0190, 0.2440}, {0.0160, 0.2555}, {0.0080, 0.2615}, {0, 0.2630}}, 6);
    profile.insert(profile.end(), knob.begin() + 1, knob.end());
    return turned(profile);
}

Mesh sweep(double halfWidth, double front, double depth, double height) {
    constexpr double kThickness = 0.02;
    constexpr int kSteps = 24;
    const double bend = 0.4 * depth;
    std::vector<glm::dvec2> face{{front, 0}};  // z and y
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = glm::half_pi<double>() * i / kSteps;
        face.push_back({-depth + bend - bend * std::sin(angle), bend - bend * std::cos(angle)});
    }
    face.push_back({-depth, height});
    std::vector<glm::dvec2> outline = face;  // and back behind it
    outline.insert(outline.end(), {{-depth - kThickness, height}, {-depth - kThickness, -kThickness}, {front, -kThickness}});

    Mesh mesh;
    const auto count = static_cast<uint32_t>(outline.size());
    for (const double side : {-1.0, 1.0})
        for (const glm::dvec2& p : outline) mesh.positions.push_back({side * halfWidth, p.y, p.x});
    std::vector<uint32_t> left, right;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t next = (i + 1) % count;
        mesh.faces.push_back(makeFace({i, i + count, next + count, next}));
    }
    // The ends: fans from the corner under the bend, which sees all of the outline.
    const uint32_t corner = count - 2;
    for (uint32_t i = 0; i + 1 < count; ++i) {
        if (i == corner || i + 1 == corner) continue;
        mesh.faces.push_back(makeFace({corner, i, i + 1}));
        mesh.faces.push_back(makeFace({corner + count, i + 1 + count, i + count}));
    }
    mesh.faces.push_back(makeFace({corner, count - 1, 0}));
    mesh.faces.push_back(makeFace({corner + count, count, count - 1 + count}));
    addNormals(mesh, kCreaseDegrees);
    return mesh;
}

Picture brushedNormals(int width, int height) {
    return paint(width, height, [](double u, double v) {
        const double tilt = 0.10 * scratch(u, v, 420) + 0.05 * scratch(u + 0.3, v, 150);
        return 0.5 + 0.5 * glm::normalize(glm::dvec3(0.01 * scratch(u, v, 90), tilt, 1));
    });
}

Picture brushedSurface(int width, int height) {
    return paint(width, height, [](double u, double v) { return glm::dvec3(0, 0.26 + 0.08 * scratch(u, v, 60), 1); });
}

}  // namespace samples
