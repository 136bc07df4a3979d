#include "cornell.hpp"

#include <array>

#include "sheet.hpp"

namespace samples {
namespace {

using Quad = std::array<glm::dvec3, 4>;

constexpr double kThickness = 0.01;  // of the walls

/// The solid between `near`, counterclockwise as seen from outside of the solid, and the same moved by `through`.
Mesh slab(const Quad& near, const glm::dvec3& through) {
    Mesh mesh;
    for (const glm::dvec3& p : near) mesh.positions.push_back(p);
    for (const glm::dvec3& p : near) mesh.positions.push_back(p + through);
    mesh.faces = {makeFace({0, 1, 2, 3}), makeFace({7, 6, 5, 4})};
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t next = (i + 1) % 4;
        mesh.faces.push_back(makeFace({i, i + 4, next + 4, next}));
    }
    return mesh;
}

/// From measured millimetres.
Mesh wall(Quad millimetres, const glm::dvec3& outward) {
    for (glm::dvec3& p : millimetres) p *= 1e-3;
    return slab(millimetres, kThickness * outward);
}

/// An upright block by the corners of its lid.
Mesh block(const std::array<glm::dvec2, 4>& xz, double height) {
    Quad lid;
    for (size_t i = 0; i < 4; ++i) lid[i] = 1e-3 * glm::dvec3{xz[i].x, height, xz[i].y};
    return slab(lid, {0, -1e-3 * height, 0});
}

// Corners of the room, in millimetres; it is no exact box.
constexpr glm::dvec3 kFloorLeft{552.8, 0, 0}, kFloorLeftBack{549.6, 0, 559.2}, kFloorRight{0, 0, 0}, kFloorRightBack{0, 0, 559.2};
constexpr glm::dvec3 kTopLeft{556, 548.8, 0}, kTopLeftBack{556, 548.8, 559.2}, kTopRight{0, 548.8, 0},
    kTopRightBack{0, 548.8, 559.2};

}  // namespace

Mesh cornellRoom() {
    Mesh room = wall({kFloorLeft, kFloorRight, kFloorRightBack, kFloorLeftBack}, {0, -1, 0});
    append(room, wall({kTopLeft, kTopLeftBack, kTopRightBack, kTopRight}, {0, 1, 0}));
    append(room, wall({kFloorLeftBack, kFloorRightBack, kTopRightBack, kTopLeftBack}, {0, 0, 1}));
    return room;
}

Mesh cornellLeft() {
    return wall({kFloorLeft, kFloorLeftBack, kTopLeftBack, kTopLeft}, {1, 0, 0});
}

Mesh cornellRight() {
    return wall({kFloorRightBack, kFloorRight, kTopRight, kTopRightBack}, {-1, 0, 0});
}

Mesh cornellShortBlock() {
    return block({glm::dvec2{130, 65}, {82, 225}, {240, 272}, {290, 114}}, 165);
}

Mesh cornellTallBlock() {
    return block({glm::dvec2{423, 247}, {265, 296}, {314, 456}, {472, 406}}, 330);
}

}  // namespace samples
