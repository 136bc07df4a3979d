// Tables to pick from, as the blob holds them.
#pragma once
#include <vector>

#include "minirt.h"

namespace minirtc {

/// What is written for a probability of something that has weight: never 0.
float probabilityOf(double share);

/// An alias table over `entries`, whose probabilities are in proportion to `weights`.
std::vector<minirt_pick> pickRows(const std::vector<uint32_t>& entries, const std::vector<double>& weights);

}  // namespace minirtc
