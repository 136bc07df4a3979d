#include "aquarium.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "noise.hpp"
#include "picture.hpp"
#include "sheet.hpp"

namespace samples {
namespace {

struct Wave {
    double length;
    double degrees;  // of its direction
    double height;
    double phase;
};

double waves(double x, double z) {
    const Wave all[] = {{0.71, 20, 0.0042, 0.3}, {0.43, -48, 0.0028, 1.9}, {0.29, 75, 0.0017, 4.0}, {0.19, 128, 0.0009, 2.2}};
    double sum = 0;
    for (const Wave& wave : all) {
        const double angle = glm::radians(wave.degrees);
        const double along = x * std::cos(angle) + z * std::sin(angle);
        sum += wave.height * std::sin(glm::two_pi<double>() * along / wave.length + wave.phase);
    }
    return sum;
}

/// A blade that leans and sways; `i` tells it from others.
Mesh blade(int i) {
    const auto random = [&](int k) { return lattice({i, k, 77}); };
    const double azimuth = glm::two_pi<double>() * (i * 0.382 + 0.1 * random(0));
    const double height = 0.55 + 0.45 * random(1);
    const double lean = 0.10 + 0.22 * random(2);
    const double sway = 0.03 + 0.03 * random(3);
    const double turn = glm::two_pi<double>() * random(4);
    const glm::dvec3 out{std::cos(azimuth), 0, std::sin(azimuth)};
    return leaf(4, 32, [&](double u, double v) {
        const double swing = sway * v * std::sin(7 * v + turn);
        const glm::dvec3 spine = out * (0.03 + lean * v * v) + glm::dvec3(swing, height * v, 0.7 * swing);
        const double facing = turn + 1.6 * v;
        const glm::dvec3 across{std::cos(facing), 0, std::sin(facing)};
        const glm::dvec3 front{-across.z, 0, across.x};
        const double width = 0.028 * (0.55 + 0.45 * std::sin(glm::pi<double>() * std::min(1.0, 0.25 + 0.6 * v))) *
                             std::sqrt(std::max(1 - v * v * v * v, 0.002));
        const double side = 2 * u - 1;
        return LeafPoint{spine + across * (width * side) + front * (0.35 * width * side * side), front * 0.003};
    });
}

}  // namespace

Mesh tank(const Aquarium& shape) {
    const glm::dvec3 outer{shape.halfWidth + shape.wall, 0, shape.halfDepth + shape.wall};
    const glm::dvec3 inner{shape.halfWidth, 0, shape.halfDepth};
    Mesh mesh;
    const auto addRing = [&](const glm::dvec3& half, double y) {  // counterclockwise seen from above
        for (const glm::dvec3& sign : {glm::dvec3{-1, 0, 1}, glm::dvec3{1, 0, 1}, glm::dvec3{1, 0, -1}, glm::dvec3{-1, 0, -1}})
            mesh.positions.push_back(half * sign + glm::dvec3(0, y, 0));
    };
    addRing(outer, -shape.wall);
    addRing(outer, shape.height);
    addRing(inner, shape.height);
    addRing(inner, 0);
    for (uint32_t ring = 0; ring < 12; ring += 4) {
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t next = (i + 1) % 4;
            mesh.faces.push_back(makeFace({ring + i, ring + next, ring + 4 + next, ring + 4 + i}));
        }
    }
    mesh.faces.push_back(makeFace({3, 2, 1, 0}));
    mesh.faces.push_back(makeFace({12, 13, 14, 15}));
    return mesh;
}

Mesh tankWater(const Aquarium& shape) {
    Mesh mesh = relief(shape.halfWidth + shape.overlap, shape.halfDepth + shape.overlap, -shape.overlap, 96, 72,
                       [&](double x, double z) { return shape.level + waves(x, z); });
    addNormals(mesh, 40);
    return mesh;
}

double sandHeight(double x, double z) {
    const double dunes = 0.05 + 0.05 * valueNoise({1.7 * x + 3, 0.5, 1.9 * z}) + 0.03 * valueNoise({4.1 * x, 8.5, 4.3 * z});
    const double bent = z + 0.05 * std::sin(3.1 * x) + 0.03 * std::sin(6.7 * x + 1);
    return dunes + 0.0035 * std::sin(glm::two_pi<double>() * bent / 0.075) * valueNoise({2.3 * x, 3.5, 2.3 * z});
}

Mesh tankSand(const Aquarium& shape) {
    const double overlap = shape.overlap / 2;  // inside of what the water takes
    Mesh mesh = relief(shape.halfWidth + overlap, shape.halfDepth + overlap, -overlap, 80, 100, sandHeight);
    for (const glm::dvec3& p : mesh.positions) mesh.uvs.push_back({2 * p.x, -2 * p.z});
    for (Face& face : mesh.faces) {
        for (Corner& corner : face) corner.uv = corner.position;
    }
    addNormals(mesh, 60);
    return mesh;
}

Mesh seaGrass() {
    Mesh mesh;
    for (int i = 0; i < 9; ++i) append(mesh, blade(i));
    addNormals(mesh, 60);
    return mesh;
}

Picture sandGrains(int width, int height) {
    return paint(width, height, [&](double u, double v) {
        const auto repeated = [&](int cells, int layer) {  // noise that is the same at both ends
            const glm::ivec3 cell{static_cast<int>(u * cells), static_cast<int>(v * cells), layer};
            return lattice(cell);
        };
        const double fine = repeated(256, 1);
        const double coarse = repeated(128, 2);
        const glm::dvec3 base = glm::mix(glm::dvec3(0.62, 0.53, 0.39), glm::dvec3(0.82, 0.74, 0.58), 0.6 * fine + 0.4 * coarse);
        const double dark = coarse > 0.965 ? 0.45 : 1.0;
        const double light = fine > 0.97 ? 1.15 : 1.0;
        return base * dark * light;
    });
}

}  // namespace samples
