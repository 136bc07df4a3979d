#include "fish.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "lathe.hpp"
#include "noise.hpp"
#include "sheet.hpp"
#include "sphere.hpp"

namespace samples {
namespace {

struct Shape {
    double halfHeight;
    double halfWidth;
    double dorsal;  // height of the fin on the back
    double anal;    // of the one below
    double tailSpan;
    double tailFork;  // 0: rounded
    glm::dvec2 eye;
    double eyeRadius;
};

Shape shapeOf(Species species) {
    if (species == Species::clownfish) return {0.185, 0.085, 0.085, 0.075, 0.14, -0.25, {0.375, 0.035}, 0.024};
    if (species == Species::tang) return {0.235, 0.06, 0.06, 0.055, 0.17, 0.45, {0.37, 0.055}, 0.02};
    return {0.285, 0.055, 0.09, 0.085, 0.13, 0.1, {0.36, 0.03}, 0.022};
}

constexpr double kNose = 0.5;
constexpr double kBody = 0.78;  // length without the tail

/// Height of the body relative to its greatest, over the way from the nose to the tail.
const Profile& outline() {
    static const Profile points = spline({{0, 0},
                                          {0.16, 0.006},
                                          {0.38, 0.05},
                                          {0.70, 0.17},
                                          {0.93, 0.32},
                                          {1.0, 0.47},
                                          {0.86, 0.66},
                                          {0.56, 0.83},
                                          {0.30, 0.95},
                                          {0.25, 1.02},
                                          {0.0, 1.04}},
                                         4);
    return points;
}

double heightAt(double along) {
    const Profile& points = outline();
    for (size_t i = 1; i < points.size(); ++i) {
        if (points[i].y < along) continue;
        return glm::mix(points[i - 1].x, points[i].x, (along - points[i - 1].y) / (points[i].y - points[i - 1].y));
    }
    return 0;
}

/// How far the side is from the middle plane, relative to the greatest: flanks taper faster than back and belly.
double flank(double along) {
    return 1.15 * std::sqrt(along) * (1 - 0.85 * along * along);
}

Mesh body(const Shape& shape) {
    Mesh mesh = lathe(outline(), 32);
    mesh.uvs.clear();
    for (glm::dvec3& p : mesh.positions) {
        const double radius = std::max(std::hypot(p.x, p.z), 1e-9);
        const double side = -p.x / radius;
        const double round = std::min(1.0, radius) * glm::mix(1.0, std::min(1.3 * flank(std::clamp(p.y, 0.0, 1.0)), 1.0), 0.8);
        p = {kNose - kBody * p.y, shape.halfHeight * p.z, shape.halfWidth * round * side};
    }
    return mesh;
}

/// A fin in the middle plane over the part [from, to] of the back (up 1) or the belly (up -1).
Mesh medianFin(const Shape& shape, double from, double to, double height, double up) {
    return leaf(36, 8, [&](double u, double v) {
        const double along = glm::mix(from, to, u);
        const double rise = height * std::pow(std::sin(glm::pi<double>() * std::pow(glm::mix(0.04, 0.93, u), 0.7)), 0.6);
        const double ray = 0.0025 * v * std::sin(95 * u);
        const double y = up * (shape.halfHeight * heightAt(along) * 0.86 + rise * v);
        return LeafPoint{{kNose - kBody * along - 0.07 * v * v, y, ray}, {0, 0, 0.010 * (1 - 0.8 * v)}};
    });
}

Mesh tail(const Shape& shape) {
    return leaf(36, 12, [&](double u, double v) {
        const double across = 2 * u - 1;
        const double root = 0.045 * across;
        const double length = 0.2 * (1 - shape.tailFork * (1 - across * across)) * (1 - 0.25 * std::pow(std::abs(across), 6));
        const double spread = glm::mix(root, shape.tailSpan * across, std::pow(v, 0.8));
        const double ray = 0.003 * v * std::sin(70 * u);
        return LeafPoint{{kNose - kBody * 0.985 - length * v, spread, ray}, {0, 0, 0.012 * (1 - 0.85 * v)}};
    });
}

Mesh pectoralFin(const Shape& shape, double side) {
    const double root = shape.halfWidth * 0.85;
    return leaf(16, 10, [&](double u, double v) {
        const double angle = glm::radians(glm::mix(-62.0, 12.0, u));
        const double length = 0.15 * v * (1 - 0.3 * (2 * u - 1) * (2 * u - 1));
        const double ray = 0.003 * v * std::sin(50 * u);
        const double y = -0.25 * shape.halfHeight + 0.02 * (u - 0.5) + length * std::sin(angle);
        const double z = side * (root + 0.55 * length + ray);
        return LeafPoint{{0.21 - length * std::cos(angle), y, z}, glm::dvec3(0.3, 0, side) * (0.006 * (1 - 0.8 * v))};
    });
}

Mesh eye(const Shape& shape, double side) {
    Mesh mesh = icosphere(2);
    const double along = (kNose - shape.eye.x) / kBody;
    const double out = shape.halfWidth * heightAt(along) * glm::mix(1.0, std::min(1.3 * flank(along), 1.0), 0.8);
    for (glm::dvec3& p : mesh.positions) {
        p = p * shape.eyeRadius * glm::dvec3(1, 1, 0.6) + glm::dvec3(shape.eye, side * (out * 0.93 - 0.2 * shape.eyeRadius));
    }
    return mesh;
}

/// 1 between lo and hi, with edges `soft` wide.
double band(double x, double lo, double hi, double soft = 0.006) {
    return glm::smoothstep(lo - soft, lo + soft, x) * (1 - glm::smoothstep(hi - soft, hi + soft, x));
}

/// White bands with black rims on orange, fins with black hems.
glm::dvec3 clownfishSkin(double x, double y, double edge) {
    const glm::dvec3 orange =
        glm::mix(glm::dvec3(0.95, 0.19, 0.015), glm::dvec3(1.0, 0.36, 0.04), glm::smoothstep(0.1, -0.18, y));
    glm::dvec3 color = orange;
    const double waist = x - 0.03 * std::cos(14 * y);
    const double lo[] = {0.225, -0.085, -0.285};
    const double hi[] = {0.29, 0.04, -0.235};
    for (int i = 0; i < 3; ++i) {
        const double bulge = i == 1 ? 0.05 * std::exp(-y * y / 0.004) : 0;
        color = glm::mix(color, glm::dvec3(0.01), band(waist, lo[i] - 0.018, hi[i] + bulge + 0.018));
        color = glm::mix(color, glm::dvec3(0.93, 0.93, 0.9), band(waist, lo[i], hi[i] + bulge));
    }
    const double hem = glm::max(glm::smoothstep(0.040, 0.052, edge), 1 - glm::smoothstep(-0.462, -0.448, x));
    return glm::mix(color, glm::dvec3(0.012), hem);
}

/// Deep blue with a black palette on the flank and a yellow tail.
glm::dvec3 tangSkin(double x, double y, double edge) {
    glm::dvec3 color = glm::mix(glm::dvec3(0.012, 0.11, 0.72), glm::dvec3(0.02, 0.2, 0.85), glm::smoothstep(0.0, -0.2, y));
    const double spine = 0.055 + 0.10 * (0.35 - x) * (x > -0.1 ? 1.0 : 0.0) * 0.4;
    const double palette = band(y, spine - 0.02 + 0.12 * glm::max(x, 0.0), 0.19, 0.012) * band(x, -0.27, 0.30, 0.02);
    const double hook = band(y, -0.05, 0.08, 0.012) * band(x, -0.27, -0.08, 0.02);
    const double hole = band(std::hypot((x - 0.02) / 1.7, y - 0.075), -1, 0.032, 0.008);
    color = glm::mix(color, glm::dvec3(0.008, 0.008, 0.02), glm::max(palette, hook) * (1 - hole));
    color = glm::mix(color, glm::dvec3(0.01, 0.01, 0.03), glm::smoothstep(0.035, 0.05, edge));
    const double yellow = (1 - glm::smoothstep(-0.285, -0.265, x)) * (1 - band(std::abs(y), 0.115 + 0.25 * (x + 0.4), 1, 0.008));
    return glm::mix(color, glm::dvec3(1.0, 0.72, 0.02), yellow);
}

/// Yellow, white in front, with dark bars and chevrons.
glm::dvec3 butterflyfishSkin(double x, double y, double edge) {
    const double front = glm::smoothstep(-0.05, 0.2, x - 0.4 * y);
    glm::dvec3 color = glm::mix(glm::dvec3(1.0, 0.66, 0.03), glm::dvec3(0.92, 0.9, 0.82), front);
    const double chevron = std::sin(95 * (x + 0.45 * std::abs(y - 0.02)));
    color = glm::mix(color, glm::dvec3(0.25, 0.2, 0.12), 0.55 * glm::smoothstep(0.62, 0.86, chevron) * band(x, -0.2, 0.24, 0.04));
    color = glm::mix(color, glm::dvec3(0.01), band(x - 0.08 * y, 0.325, 0.39));   // through the eye
    color = glm::mix(color, glm::dvec3(0.01), band(x + 0.1 * y, -0.275, -0.24));  // before the tail
    return glm::mix(color, glm::dvec3(0.02, 0.015, 0.01), band(edge, 0.055, 0.068, 0.004));
}

glm::dvec3 skinAt(Species species, double x, double y) {
    const Shape shape = shapeOf(species);
    const double along = (kNose - x) / kBody;
    const double bodyHalf = along < 1 ? shape.halfHeight * heightAt(std::max(along, 0.0)) : 0.05;
    const double edge = along < 0.98 ? std::abs(y) - bodyHalf : 0;  // how far out on a fin of the back or belly
    glm::dvec3 color = species == Species::clownfish ? clownfishSkin(x, y, edge)
                       : species == Species::tang    ? tangSkin(x, y, edge)
                                                     : butterflyfishSkin(x, y, edge);
    const double scales = std::sin(260 * (x + 0.35 * y)) * std::sin(260 * (x - 0.35 * y));
    color *= 1 + 0.07 * scales + 0.16 * (valueNoise({40 * x, 40 * y, 2}) - 0.5);
    const double gill =
        band(std::hypot((x - 0.35) / 0.14, y / (0.75 * shape.halfHeight)), 0.97, 1.03, 0.02) * (x < 0.32 ? 1.0 : 0.0);
    color *= 1 - 0.45 * gill;
    const double fromEye = std::hypot(x - shape.eye.x, y - shape.eye.y) / shape.eyeRadius;
    if (fromEye < 1.12)
        color = fromEye < 0.62 ? glm::dvec3(0.004) : fromEye < 0.98 ? glm::dvec3(0.55, 0.42, 0.2) : glm::dvec3(0.02);
    return color;
}

}  // namespace

Mesh fish(Species species, double swing) {
    const Shape shape = shapeOf(species);
    Mesh mesh = body(shape);
    append(mesh, medianFin(shape, 0.24, 0.93, shape.dorsal, 1));
    append(mesh, medianFin(shape, 0.58, 0.92, shape.anal, -1));
    append(mesh, tail(shape));
    for (const double side : {-1.0, 1.0}) {
        append(mesh, pectoralFin(shape, side));
        append(mesh, eye(shape, side));
    }
    for (const glm::dvec3& p : mesh.positions) mesh.uvs.push_back({p.x + 0.5, p.y + 0.5});
    for (Face& face : mesh.faces) {
        for (Corner& corner : face) corner.uv = corner.position;
    }
    for (glm::dvec3& p : mesh.positions) {
        const double behind = std::max(0.0, 0.25 - p.x);
        p.z += swing * (2.2 * behind * behind - 0.25 * behind);
    }
    addNormals(mesh, 70);
    return mesh;
}

Picture fishSkin(Species species, int size) {
    return paint(size, size, [&](double u, double v) { return skinAt(species, u - 0.5, 0.5 - v); });
}

}  // namespace samples
