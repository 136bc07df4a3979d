// Glasses, bowls and vases: solids of revolution in metres that stand on y = 0, with vertex normals.
#pragma once
#include "mesh.hpp"

namespace samples {

/// A whisky tumbler and, where it is needed to fill it, the shape of its inside.
struct Tumbler {
    double bottomRadius = 0.037;
    double topRadius = 0.042;
    double height = 0.092;
    double wall = 0.0028;
    double base = 0.014;  // thickness of the bottom
    double innerFillet = 0.010;
    int flutes = 0;  // grooves cut around the lower outside; 0: plain
    double fluteDepth = 0.0014;
};

Mesh tumbler(const Tumbler& shape);

/// What fills the tumbler up to height `level`. It reaches `overlap` into the glass, as nested volumes are modelled, and
/// climbs the wall by a meniscus.
Mesh tumblerFilling(const Tumbler& shape, double level, double overlap = 0.0003);

Mesh wineGlass();
Mesh bowl();

/// Has texture coordinates.
Mesh vase();

}  // namespace samples
