// A glass tank and what fills it, in metres; the floor of the inside is y = 0.
#pragma once
#include "mesh.hpp"

namespace samples {

struct Aquarium {
    double halfWidth = 1.0;  // of the inside, x
    double halfDepth = 0.7;  // z
    double height = 1.0;
    double wall = 0.02;
    double level = 0.9;      // of the water
    double overlap = 0.004;  // of what fills the tank into its walls
};

/// Open at the top, all edges sharp.
Mesh tank(const Aquarium& shape);

/// Water with waves on it.
Mesh tankWater(const Aquarium& shape);

/// Sand with dunes. Texture coordinates in steps of half a metre.
Mesh tankSand(const Aquarium& shape);

/// The sand's surface.
double sandHeight(double x, double z);

/// A bunch of long blades, 1 high, roots at the origin.
Mesh seaGrass();

}  // namespace samples
