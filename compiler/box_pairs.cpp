#include "box_pairs.hpp"

#include <algorithm>

namespace minirtc {

bool areNear(const Aabb& a, const Aabb& b, double reach) {
    for (int i = 0; i < 3; ++i)
        if (!(double{a.lo[i]} - reach <= b.hi[i] && double{b.lo[i]} - reach <= a.hi[i] && a.lo[i] <= a.hi[i] &&
              b.lo[i] <= b.hi[i]))
            return false;
    return true;
}

std::vector<IndexPair> nearPairs(const std::vector<Aabb>& boxes, double reach,
                                 const std::function<bool(uint32_t, uint32_t)>& wanted) {
    std::vector<uint32_t> byStart(boxes.size());
    for (uint32_t i = 0; i < boxes.size(); ++i) byStart[i] = i;
    std::sort(byStart.begin(), byStart.end(),
              [&](uint32_t i, uint32_t k) { return std::tie(boxes[i].lo.x, i) < std::tie(boxes[k].lo.x, k); });

    std::vector<IndexPair> pairs;
    std::vector<uint32_t> open;  // boxes that the sweep may still be in
    for (const uint32_t next : byStart) {
        const double start = double{boxes[next].lo.x} - reach;
        open.erase(std::remove_if(open.begin(), open.end(), [&](uint32_t i) { return boxes[i].hi.x < start; }), open.end());
        for (const uint32_t i : open)
            if (areNear(boxes[i], boxes[next], reach) && wanted(i, next))
                pairs.emplace_back(std::min(i, next), std::max(i, next));
        open.push_back(next);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace minirtc
