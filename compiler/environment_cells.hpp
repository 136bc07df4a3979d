// The background as cells that are picked by how much light they send.
#pragma once
#include "minirt.h"
#include "scene.hpp"

namespace minirtc {

/// Cell (i, j), row by row, is the background image's u in [i, i + 1) / columns and v in [j, j + 1) / rows.
struct EnvironmentCells {
    uint32_t columns = 1;
    uint32_t rows = 1;
    std::vector<double> weights;  // integral of luminance over the solid angle of each cell, W/m^2
    double total = 0;
};

/// Of the image as it is seen, filtered between its texels: no cell that shines anywhere has weight 0. A constant background is one cell.
EnvironmentCells environmentCells(const Scene& scene);

/// Section "ENVIRON". A black background's cells are picked alike.
std::vector<minirt_pick> environmentTable(const EnvironmentCells& cells);

}  // namespace minirtc
