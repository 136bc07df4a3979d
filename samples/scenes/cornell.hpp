// The Cornell box as it was measured at Cornell University's Program of Computer Graphics; in metres, the open side at z = 0.
#pragma once
#include "mesh.hpp"

namespace samples {

/// Floor, ceiling and back wall, as slabs with a thickness outward.
Mesh cornellRoom();

/// The side walls: left and right for a camera that looks along +Z.
Mesh cornellLeft();
Mesh cornellRight();

/// Both stand on the floor.
Mesh cornellShortBlock();
Mesh cornellTallBlock();

}  // namespace samples
