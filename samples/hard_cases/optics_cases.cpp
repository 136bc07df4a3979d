// Glass at its limits: the critical angle, indices of 1 and of extremes, normals that disagree, reflectance by Fresnel's equations.
#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>

#include "cases.hpp"
#include "wall.hpp"

namespace hard_cases {
namespace {

/// A closed box.
std::string box(const dvec3& lo, const dvec3& hi) {
    std::string obj;
    for (int i = 0; i < 8; ++i)
        obj += "v " + std::to_string(i & 1 ? hi.x : lo.x) + " " + std::to_string(i & 2 ? hi.y : lo.y) + " " +
               std::to_string(i & 4 ? hi.z : lo.z) + "\n";
    return obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

Json glass(double ior) {
    return {{"model", "pbr"}, {"roughness", 0}, {"transmission", 1}, {"ior", ior}};
}

/// Unpolarised reflectance; `eta`: the index behind over the one in front.
double fresnel(double cosI, double eta) {
    const double sin2T = (1 - cosI * cosI) / (eta * eta);
    if (sin2T >= 1) return 1;
    const double cosT = std::sqrt(1 - sin2T);
    const double parallel = (eta * cosI - cosT) / (eta * cosI + cosT);
    const double perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
    return (parallel * parallel + perpendicular * perpendicular) / 2;
}

/// From in a block of glass towards its face y = 0, before white: of all light only what goes through that face gets into the picture.
Shot fromInside(Stage& stage, double index, double degrees, double vfov) {
    stage.write("block.obj", box({-100, -100, -100}, {100, 0, 100}));
    const double angle = glm::radians(degrees);
    Shot shot;
    shot.view = {{0, -1, 0}, {0, -1 + std::cos(angle), -std::sin(angle)}, vfov, 64};
    shot.background = 1;
    shot.maxDepth = 1;
    shot.materials["glass"] = glass(index);
    shot.objects = {meshOf("block.obj", "glass")};
    return shot;
}

/// Picture's transmittance through a face against Fresnel's equations.
double reflectanceInside(Stage& stage) {
    constexpr double kIndex = 1.5;
    const Shot shot = fromInside(stage, kIndex, 30, 55);
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        const double cosine = shot.view.direction(x, y).y;
        // Right at the critical angle the reflectance rises with infinite slope.
        if (std::abs((1 - cosine * cosine) * kIndex * kIndex - 1) < 1e-2) return 0.0;
        return std::abs(picture.at(x, y) - (1 - fresnel(cosine, 1 / kIndex)));
    });
}

/// A mirror of glass's reflectance, under white.
double reflectanceOutside(Stage& stage) {
    Shot shot;
    shot.view = {{0, 3, 5}, {0, 0, 0}, 60, 64};
    shot.background = 1;
    shot.materials["mirror"] = {{"model", "phong"}, {"diffuse", 0}, {"reflect", 1}, {"fresnel", true}, {"ior", 1.5}};
    shot.objects = {rectangle({-1e3, 0, -1e3}, {0, 0, 2e3}, {2e3, 0, 0}, "mirror")};
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        const double cosine = -shot.view.direction(x, y).y;
        return cosine < 0.02 ? 0 : std::abs(picture.at(x, y) - fresnel(cosine, 1.5));
    });
}

/// Rays within 1e-5 radians of the critical angle: how far from it, in sine squared, one goes to the wrong side.
double criticalAngle(Stage& stage, double index) {
    const double degrees = glm::degrees(std::asin(1 / index));
    const Shot shot = fromInside(stage, index, degrees, glm::degrees(2e-5));
    const Picture picture = stage.render(shot);
    return largestOf(picture, [&](uint32_t x, uint32_t y) {
        const dvec3 d = shot.view.direction(x, y);
        const double beyond = d.x * d.x + d.z * d.z - 1 / (index * index);
        const bool through = picture.at(x, y) > 0;
        return through == (beyond < 0) ? 0 : std::abs(beyond);
    });
}

/// A chequered floor behind a ball: how many pixels differ from the picture without the ball.
double indexOne(Stage& stage) {
    Shot shot;
    shot.view = {{0, 2, 4}, {0, 0.5, 0}, 40, 64};
    shot.background = 0.5;
    shot.materials["dark"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {0.25, 0.25, 0.25}}};
    shot.materials["bright"] = {{"model", "pbr"}, {"baseColor", {0, 0, 0}}, {"emissive", {1, 1, 1}}};
    shot.materials["checker"] = {{"model", "checker"}, {"a", "dark"}, {"b", "bright"}, {"scale", 0.0625}};
    shot.materials["air"] = glass(1);
    shot.objects = {rectangle({-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, "checker")};
    const Picture without = stage.render(shot);
    shot.objects.push_back({{"sphere", {{"center", {0, 0.7, 0}}, {"radius", 0.6}}}, {"material", "air"}});
    const Picture with = stage.render(shot);
    return percentOf(with, [&](uint32_t x, uint32_t y) { return with.at(x, y) != without.at(x, y); });
}

/// Balls and blocks in a white room: clear glass of any index gives back no more than it gets, and no NaN.
double extremes(Stage& stage) {
    stage.write("block.obj", box({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}));
    Shot shot;
    shot.view = {{0.3, 1, 8}, {0, 0, 0}, 35, 64};
    shot.background = 1;
    shot.maxDepth = 8;
    int place = 0;
    for (const double index : {0.25, 1.0001, 4.0}) {
        const std::string name = "glass " + std::to_string(place);
        const double x = 1.7 * (place++ - 1);
        shot.materials[name] = glass(index);
        shot.objects.push_back({{"sphere", {{"center", {x, 0.9, 0}}, {"radius", 0.7}}}, {"material", name}});
        Json block = meshOf("block.obj", name);
        block["translate"] = {x, -0.9, 0};
        block["rotate"] = {20, 30, 10};
        shot.objects.push_back(block);
    }
    const Picture picture = stage.render(shot);
    const double excess = largestOf(picture, [&](uint32_t x, uint32_t y) { return picture.at(x, y) - 1; });
    return excess + static_cast<double>(picture.stats.nan_pixels);
}

/// Up into a panorama of four columns, in which all of them and the seam meet. Not within a ten thousandth of the pole, where a float's direction has
/// no certain angle.
double pole(Stage& stage) {
    // Radiance's format, a row without run lengths: mantissas with the exponent 0.
    const unsigned char columns[] = {64, 192, 192, 64};
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    for (int row = 0; row < 2; ++row)
        for (const unsigned char value : columns) hdr += std::string(3, static_cast<char>(value)) + static_cast<char>(128);
    stage.write("sky.hdr", hdr);
    Shot shot;
    shot.view = {dvec3(0), {0, 1, 0}, 10, 128, {0, 0, -1}};
    shot.panorama = "sky.hdr";
    shot.materials["black"] = {{"model", "phong"}, {"diffuse", 0}};
    shot.objects = {rectangle({-1, -2, -1}, {0, 0, 2}, {2, 0, 0}, "black")};
    const Picture picture = stage.render(shot);
    return static_cast<double>(picture.stats.nan_pixels) + largestOf(picture, [&](uint32_t x, uint32_t y) {
               const dvec3 d = shot.view.direction(x, y);
               if (std::hypot(d.x, d.z) < 1e-4) return 0.0;
               const double column = (std::atan2(d.z, d.x) / (2 * glm::pi<double>()) + 0.5) * 4 - 0.5;
               const int left = static_cast<int>(std::floor(column));
               const double share = column - left;
               const double radiance = columns[(left + 4) % 4] * (1 - share) + columns[(left + 5) % 4] * share;
               return std::abs(picture.at(x, y) - radiance / 256);
           });
}

/// A coarse ball of mirrors with smooth normals in a white room: all that it reflects is white, but for what went into it.
double normalsApart(Stage& stage) {
    stage.write("gem.obj",
                "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
    Shot shot;
    shot.view = {{1, 1.5, 4}, {0, 0, 0}, 30, 64};
    shot.background = 1;
    shot.materials["mirror"] = {{"model", "phong"}, {"diffuse", 0}, {"reflect", 1}};
    Json gem = meshOf("gem.obj", "mirror");
    gem["smooth"] = true;
    shot.objects = {gem};
    const Picture picture = stage.render(shot);
    return percentOf(picture, [&](uint32_t x, uint32_t y) { return picture.at(x, y) != 1; });
}

/// A lit wall with smooth normals, with and without faces of no area at each of its vertices: how many pixels differ, and NaNs.
double smoothBesideDegenerates(Stage& stage) {
    constexpr int kSide = 9;
    std::string obj;
    char line[96];
    for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i) {
            std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", 0.2 * i - 0.9, 0.2 * j - 0.9, 0.1 * ((i * 7 + j * 3) % 5));
            obj += line;
        }
    std::string degenerate;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const int a = j * (kSide + 1) + i + 1;
            const int b = a + kSide + 1;
            std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", a, a + 1, b + 1, a, b + 1, b);
            obj += line;
            std::snprintf(line, sizeof line, "f %d %d %d\n", a, a, b + 1);
            degenerate += line;
        }
    Shot shot;
    shot.view = {{0, 0, 3}, {0, 0, 0}, 30, 64};
    shot.materials["white"] = {{"model", "phong"}};
    shot.lights = Json::array({{{"type", "directional"}, {"direction", {-1, -2, -3}}}});
    shot.objects = {meshOf("wall.obj", "white")};
    shot.objects[0]["smooth"] = true;
    stage.write("wall.obj", obj);
    const Picture plain = stage.render(shot);
    stage.write("wall.obj", obj + degenerate);
    const Picture beside = stage.render(shot);
    return static_cast<double>(beside.stats.nan_pixels) +
           percentOf(beside, [&](uint32_t x, uint32_t y) { return beside.at(x, y) != plain.at(x, y); });
}

}  // namespace

std::vector<HardCase> opticsCases() {
    const std::string wrongSide = "sin^2 from the critical angle on the wrong side";
    return {
        {"reflectance from outside", "a mirror of index 1.5 at all angles up to 89 degrees", "error", 1e-5, reflectanceOutside},
        {"reflectance from inside", "a face of glass of index 1.5 seen from within", "error", 1e-5, reflectanceInside},
        {"critical angle", "rays in glass of index 1.5 at the critical angle", wrongSide, 8.8e-7,
         [](Stage& s) { return criticalAngle(s, 1.5); }},
        {"critical angle of diamond", "rays in diamond, of index 2.417, at the critical angle", wrongSide, 3.1e-6,
         [](Stage& s) { return criticalAngle(s, 2.417); }},
        {"index 1", "a ball of index 1 before a floor, against no ball", "% of pixels that differ", 0, indexOne},
        {"extreme indices", "glass of index 0.25, 1.0001 and 4 in a white room", "radiance over 1, and NaNs", 1e-5, extremes},
        // Texture coordinates to 3e-7 turns, on a slope of 2 a turn, for directions whose angle is known to 2e-4 in the nearest pixel.
        {"pole", "where all columns of a panorama meet overhead", "error, and NaNs", 1e-4, pole},
        {"normals apart", "a mirror whose smooth normals are far from its faces'", "% of rays that went into it", 0,
         normalsApart},
        {"normals at degenerates", "smooth normals of vertices that faces without area share, against none such",
         "% of pixels that differ, and NaNs", 0, smoothBesideDegenerates},
    };
}

}  // namespace hard_cases
