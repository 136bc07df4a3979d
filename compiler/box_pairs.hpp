// Which of many boxes come near each other.
#pragma once
#include <functional>
#include <utility>

#include "bvh.hpp"

namespace minirtc {

/// True where the boxes are no more than `reach` apart in every direction; never for empty ones.
bool areNear(const Aabb& a, const Aabb& b, double reach);

using IndexPair = std::pair<uint32_t, uint32_t>;

/// All pairs (i, k), i < k, of boxes that are near each other and are `wanted`, in ascending order. By a sweep along x.
std::vector<IndexPair> nearPairs(const std::vector<Aabb>& boxes, double reach,
                                 const std::function<bool(uint32_t, uint32_t)>& wanted);

}  // namespace minirtc
