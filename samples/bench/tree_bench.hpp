// How fast hierarchies are built and how good they are, ours and Embree's.
#pragma once
#include <string>
#include <vector>

#include "meshes.hpp"
#include "timing.hpp"

namespace bench {

struct TreeResult {
    std::string name;
    Spread mtrianglesPerSecond;
    double sahCost = 0;  // minirtc::sahCost: 1 a node, 1 a triangle
    size_t nodes = 0;
    size_t references = 0;  // of leaves; more than there are triangles where these were split
};

/// In turns. Ours first.
std::vector<TreeResult> benchTrees(const Mesh& mesh, int rounds);

}  // namespace bench
