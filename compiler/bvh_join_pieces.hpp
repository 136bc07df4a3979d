// Undoes splits of primitives where they do not pay.
#pragma once
#include "bvh_links.hpp"

namespace minirtc {

/// Gives up pieces of primitives, whose leaf of another piece then holds both: first all that cost nothing to give up, then those which cost the
/// least, until the tree takes no more than `mostBytes`, or has no piece to give.
void joinPieces(LinkedTree& tree, double mostBytes);

}  // namespace minirtc
