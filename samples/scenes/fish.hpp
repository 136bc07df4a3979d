// Fish, 1 long, head towards +x, back up. Texture coordinates are those of a view from the side: (x, y) + 1/2.
#pragma once
#include "mesh.hpp"
#include "picture.hpp"

namespace samples {

enum class Species { clownfish, tang, butterflyfish };

/// With its tail swung to +z by about `swing`.
Mesh fish(Species species, double swing);

/// What goes with the texture coordinates.
Picture fishSkin(Species species, int size);

}  // namespace samples
