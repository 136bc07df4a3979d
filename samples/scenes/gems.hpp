// Cut stones, table up. A facet is a plane, so the meet points of a cut fix it (proportions cited at each cut).
#pragma once
#include "mesh.hpp"

namespace samples {

constexpr int kBrilliantGirdleFacets = 64;

/// Round brilliant of girdle radius 1, the girdle about y = 0: 57 facets (table, 8 stars, 8 bezels, 16 upper halves;
/// 16 lower halves, 8 pavilion mains, no culet) and a girdle of kBrilliantGirdleFacets.
Mesh brilliantCut();

/// Step cut over a rectangle of half sides `halfLength` (x) and `halfWidth` (z) with bevelled corners, girdle about y = 0.
/// Square: the Asscher cut; longer: the emerald cut.
Mesh stepCut(double halfLength, double halfWidth);

}  // namespace samples
