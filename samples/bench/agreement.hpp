// Whether two tracers found the same hits.
#pragma once
#include "ray_sets.hpp"

namespace bench {

struct Agreement {
    size_t rays = 0;
    size_t hits = 0;      // of the first
    size_t onlyOne = 0;   // one hits, the other misses
    size_t distance = 0;  // both hit, at distances that differ by more than the tolerance
    size_t differing() const { return onlyOne + distance; }
    /// At most one ray in 100,000 differs: those that meet an edge or graze a triangle, where both answers are right within rounding.
    bool good() const { return differing() * 100000 <= rays; }
};

/// `tolerance` is of t. Of any-hit rays only whether there is a hit counts.
Agreement agreement(const std::vector<Hit>& first, const std::vector<Hit>& second, bool anyHit, float tolerance);

}  // namespace bench
