#include "bvh_split.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

Box boxOf(const Ref* refs, uint32_t count) {
    Box box;
    for (uint32_t i = 0; i < count; ++i) box.grow(refs[i]);
    return box;
}

}  // namespace

// Bins where they pay: the fewer the primitives, the fewer of them. A scale that is not finite stands for centres that agree,
// or that lie too far apart for float.
BinGrid::BinGrid(const Box& centroids2, uint32_t size) : count(std::min(kMaxBins, 4 + size / 4)) {
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = centroids2.hi[axis] - centroids2.lo[axis];
        const float binsPerUnit = static_cast<float>(count) / extent;
        origin[axis] = centroids2.lo[axis];
        scale[axis] = std::isfinite(extent) && std::isfinite(binsPerUnit) ? binsPerUnit : 0.0f;
    }
}

void Bins::add(const BinGrid& grid, const Ref* refs, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const uint32_t bin = grid.bin(refs[i], axis);
            box[axis][bin].grow(refs[i]);
            ++size[axis][bin];
        }
}

void Bins::add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
        for (uint32_t i = 0; i < kMaxBins; ++i) {
            box[axis][i].grow(other.box[axis][i]);
            size[axis][i] += other.size[axis][i];
        }
}

uint32_t Bins::sizeBelow(int axis, uint32_t bin) const {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < bin; ++i) sum += size[axis][i];
    return sum;
}

Box centroidBounds2(const Ref* refs, uint32_t count) {
    Box box;
    for (uint32_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const float c = refs[i].center2(axis);
            box.lo[axis] = c < box.lo[axis] ? c : box.lo[axis];
            box.hi[axis] = c > box.hi[axis] ? c : box.hi[axis];
        }
    return box;
}

Split bestSplit(const Bins& bins, const BinGrid& grid) {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.scale[axis] == 0) continue;
        float secondCost[kMaxBins];
        Box box;
        uint32_t size = 0;
        for (uint32_t i = grid.count - 1; i > 0; --i) {
            box.grow(bins.box[axis][i]);
            size += bins.size[axis][i];
            secondCost[i] = size ? box.halfArea() * static_cast<float>(size) : Box::kInfinity;
        }
        box = Box(), size = 0;
        for (uint32_t i = 1; i < grid.count; ++i) {
            box.grow(bins.box[axis][i - 1]);
            size += bins.size[axis][i - 1];
            if (size == 0) continue;
            const float cost = box.halfArea() * static_cast<float>(size) + secondCost[i];
            if (cost < best.cost) best = {cost, axis, i, size};
        }
    }
    return best;
}

void partition(const BinGrid& grid, const Split& split, const Ref* refs, uint32_t count, Ref* first, Ref* second) {
    Ref* end[2] = {first, second};
    for (uint32_t i = 0; i < count; ++i) *end[grid.bin(refs[i], split.axis) >= split.bin]++ = refs[i];
}

Halves halvesAfter(const Range& range, const Bins& bins, const BinGrid& grid, const Split& split) {
    const uint32_t n = split.firstSize;
    Halves halves{{{range.spare, range.refs, n, {}}, {range.spare + n, range.refs + n, range.size - n, {}}}};
    for (uint32_t i = 0; i < grid.count; ++i) halves.half[i >= split.bin].box.grow(bins.box[split.axis][i]);
    return halves;
}

bool splitBinned(const Range& range, Halves& halves) {
    if (!(range.box.halfArea() > 0)) return false;
    const BinGrid grid(centroidBounds2(range.refs, range.size), range.size);
    Bins bins;
    bins.add(grid, range.refs, range.size);
    const Split split = bestSplit(bins, grid);
    if (split.firstSize == 0) return false;
    partition(grid, split, range.refs, range.size, range.spare, range.spare + split.firstSize);
    halves = halvesAfter(range, bins, grid, split);
    return true;
}

bool splitSwept(const Range& range, Halves& halves) {
    if (!(range.box.halfArea() > 0)) return false;
    const uint32_t n = range.size;
    float bestCost = Box::kInfinity;
    uint8_t bestOrder[kMaxSweepSize];
    uint32_t firstSize = 0;
    Box firstBox, secondBox;
    for (int axis = 0; axis < 3; ++axis) {
        uint8_t order[kMaxSweepSize];
        for (uint32_t i = 0; i < n; ++i) {
            const float c = range.refs[i].center2(axis);
            uint32_t j = i;
            for (; j > 0 && range.refs[order[j - 1]].center2(axis) > c; --j) order[j] = order[j - 1];
            order[j] = static_cast<uint8_t>(i);
        }
        if (!(range.refs[order[0]].center2(axis) < range.refs[order[n - 1]].center2(axis))) continue;
        Box second[kMaxSweepSize];
        second[n - 1] = range.refs[order[n - 1]];
        for (uint32_t i = n - 1; i > 1; --i) second[i - 1] = second[i], second[i - 1].grow(range.refs[order[i - 1]]);
        Box first;
        for (uint32_t i = 1; i < n; ++i) {
            first.grow(range.refs[order[i - 1]]);
            const float cost = first.halfArea() * static_cast<float>(i) + second[i].halfArea() * static_cast<float>(n - i);
            if (cost < bestCost) {
                bestCost = cost, firstSize = i;
                std::copy(order, order + n, bestOrder);
                firstBox = first, secondBox = second[i];
            }
        }
    }
    if (firstSize == 0) return false;
    for (uint32_t i = 0; i < n; ++i) range.spare[i] = range.refs[bestOrder[i]];
    halves = {{{range.spare, range.refs, firstSize, firstBox},
               {range.spare + firstSize, range.refs + firstSize, n - firstSize, secondBox}}};
    return true;
}

Halves splitMedian(const Range& range) {
    const Box centroids2 = centroidBounds2(range.refs, range.size);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (centroids2.hi[i] - centroids2.lo[i] > centroids2.hi[axis] - centroids2.lo[axis]) axis = i;
    if (centroids2.hi[axis] > centroids2.lo[axis])
        std::stable_sort(range.refs, range.refs + range.size,
                         [axis](const Ref& a, const Ref& b) { return a.center2(axis) < b.center2(axis); });
    const uint32_t n = range.size / 2;
    return {{{range.refs, range.spare, n, boxOf(range.refs, n)},
             {range.refs + n, range.spare + n, range.size - n, boxOf(range.refs + n, range.size - n)}}};
}

}  // namespace minirtc
