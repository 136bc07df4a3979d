// Tubes along torus knots.
#pragma once
#include "mesh.hpp"

namespace samples {

struct TorusKnot {
    int p = 2;  // turns about the axis (+Y)
    int q = 3;  // turns around the ring
    double ringRadius = 1;
    double windingRadius = 0.45;
    double tubeRadius = 0.22;
    int segments = 320;
    int sides = 36;
};

Mesh torusKnot(const TorusKnot& knot);

}  // namespace samples
