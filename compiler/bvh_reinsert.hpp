// Moves subtrees of a finished hierarchy to where they cost less.
#pragma once
#include "bvh_links.hpp"
#include "parallel.hpp"

namespace minirtc {

/// In sweeps: the best new places of half of the nodes are found in parallel [Meister and Bittner 2018, "Parallel Reinsertion for Bounding Volume
/// Hierarchy Optimization"] and the moves are made one after the other, the best first, each only where it lowers the cost by then: no
/// locks, and the same tree on any number of threads. A sweep tries what has changed since the one before; where that wins little the next one
/// tries all. No path gets longer than kMaxDepth.
void reinsertSubtrees(LinkedTree& tree, ThreadPool& pool);

}  // namespace minirtc
