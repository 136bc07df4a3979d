// A shrub in a meadow: stems, and leaves and grass as cards, which are flat quads whose pictures have holes.
#pragma once
#include "mesh.hpp"
#include "picture.hpp"

namespace samples {

/// Stems and branches; closed, with vertex normals. They stand on y = 0.
Mesh shrubStems();

/// A card at the end of each twig of those stems. Texture coordinates over [0,1]^2 of each card, its stalk at v = 0.
Mesh shrubLeaves();

/// Tufts of grass: crossed cards around the origin, out to `radius`.
Mesh meadow(double radius, int tufts);

/// A twig with leaflets on either side, and a tuft of blades; transparent around them.
Picture leafCard(int size);
Picture grassCard(int size);

}  // namespace samples
