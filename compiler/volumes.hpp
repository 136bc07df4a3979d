// Which bodies are volumes, how they share space where they overlap, and whether they are closed as volumes must be.
#pragma once
#include "geometry.hpp"

namespace minirtc {

/// One volume displaces another where both are.
struct Displacement {
    uint32_t above = 0;  // index into Geometry::bodies
    uint32_t below = 0;
    std::string reason;
};

struct Volumes {
    /// Geometry::bodies in the numbering of the blob: first the volumes, each displacing those before it, then all other bodies.
    std::vector<uint32_t> order;
    uint32_t count = 0;  // of volumes
    /// Overlapping pairs, by name of the bodies.
    std::vector<Displacement> displacements;
    /// Most volumes that a ray can be in at once, by the pairs that overlap; 0 where there is no volume, at most kMostNested.
    uint32_t capacity = 0;
    // What a kernel must know of them, with the bodies' names; empty where it need not:
    std::string overlap;      // two volumes share space: "ice.obj in water.obj"
    std::string content;      // something that is no volume, or a light, lies in a volume: "fish.obj in water.obj"
    std::string lightInside;  // a light lies in a volume, so that hidden surfaces may stand between it and what it lights
    std::string selfOverlap;  // a volume that folds over itself, so that entries and exits must be counted
};

constexpr uint32_t kMostNested = 16;

/// Checks that each volume is closed and consistently oriented, finds which overlap, and derives the order. Throws Error naming the object
/// where a volume is open; warns where the order is a guess or where its surface and another's coincide or overlap by less than rounding
/// can tell. On up to `threads` threads (0: all cores); the result does not depend on it.
Volumes analyseVolumes(const Scene& scene, const Geometry& geometry, Diagnostics& diagnostics, unsigned threads = 0);

}  // namespace minirtc
