// Picking by weight in constant time: the alias method (Walker 1977; built as in Vose 1991).
#pragma once
#include <cstdint>
#include <vector>

namespace minirtc {

/// An entry is chosen with all alike. It stands for itself where 32 random bits are less than `threshold`, else for entry `alias`.
struct AliasEntry {
    uint32_t alias = 0;
    uint32_t threshold = 0;
};

/// Picks i with probability weights[i] / their sum, to 2^-32 of the share of an entry. What has weight is picked; what has none is not.
/// Weights are finite and not negative, and one of them is over 0.
std::vector<AliasEntry> aliasTable(const std::vector<double>& weights);

}  // namespace minirtc
