// All that shines in one table, to be picked by power.
#pragma once
#include "bvh.hpp"
#include "environment_cells.hpp"
#include "minirt.h"

namespace minirtc {

struct LightTable {
    std::vector<minirt_pick> emitters;  // section "EMITTERS"; where nothing shines, the environment is its one entry
    std::vector<float> densities;       // of each material: over the area of its surfaces, with which a point is picked, 1/m^2
    float environment = 0;              // probability
};

/// Primitives by their place in `bvh`, then lights, then the environment.
LightTable lightTable(const Scene& scene, const Geometry& geometry, const Bvh& bvh, const EnvironmentCells& environment);

}  // namespace minirtc
