// Moves subtrees of a finished hierarchy to where they cost less.
#pragma once
#include "bvh.hpp"
#include "parallel.hpp"

namespace minirtc {

/// The hierarchy after rounds in which the best new place of each node is found in parallel [Meister and Bittner 2018, "Parallel
/// Reinsertion for Bounding Volume Hierarchy Optimization"] and the moves are made one after the other, the best first, each only where
/// it lowers the cost by then: no locks, and the same tree on any number of threads. Leaves are joined at the end where that is no dearer;
/// best given with one primitive each. No path gets longer than kMaxDepth. `bvh` has at least one node with two children.
Bvh reinsertSubtrees(const Bvh& bvh, ThreadPool& pool);

}  // namespace minirtc
