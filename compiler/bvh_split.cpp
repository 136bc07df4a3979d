#include "bvh_split.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

Box boxOf(const Ref* refs, uint32_t count) {
    Box box = Box::empty();
    for (uint32_t i = 0; i < count; ++i) box.grow(refs[i]);
    return box;
}

/// Ranks by counting, on all axes at once: no branch to mispredict. Equal centres keep their order.
void sortAlongAxes(const Ref* refs, uint32_t count, uint8_t (&order)[3][kMaxSweepSize]) {
    Int4 rank[kMaxSweepSize] = {};
    for (uint32_t i = 1; i < count; ++i)
        for (uint32_t j = 0; j < i; ++j) {
            const Int4 swapped = refs[j].center2() > refs[i].center2();  // -1 where true
            rank[j] -= swapped;
            rank[i] += swapped + 1;
        }
    for (uint32_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis) order[axis][rank[i][axis]] = static_cast<uint8_t>(i);
}

}  // namespace

// Bins where they pay: the fewer the primitives, the fewer of them. The scale is a little low so that the last centre falls into
// the last bin. One that is not finite stands for centres that agree, or that lie too far apart for float.
BinGrid::BinGrid(const Box& centroids2, uint32_t size) : count(std::min(kMaxBins, 4 + size / 4)), origin(centroids2.lo), scale{} {
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = centroids2.hi[axis] - centroids2.lo[axis];
        const float binsPerUnit = static_cast<float>(count) * (1 - 1e-6f) / extent;
        if (std::isfinite(extent) && std::isfinite(binsPerUnit)) scale[axis] = binsPerUnit;
    }
}

Bins::Bins(uint32_t n) : count(n) {
    for (int axis = 0; axis < 3; ++axis) {
        std::fill_n(box[axis], count, Box::empty());
        std::fill_n(size[axis], count, 0u);
    }
}

void Bins::add(const BinGrid& grid, const Ref* refs, uint32_t refCount) {
    for (uint32_t i = 0; i < refCount; ++i) {
        const Int4 bins = grid.bins(refs[i]);
        for (int axis = 0; axis < 3; ++axis) {
            box[axis][bins[axis]].grow(refs[i]);
            ++size[axis][bins[axis]];
        }
    }
}

void Bins::add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
        for (uint32_t i = 0; i < count; ++i) {
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
    Box box = Box::empty();
    for (uint32_t i = 0; i < count; ++i) {
        const Float4 point = refs[i].center2();
        box.grow({point, point});
    }
    return box;
}

Split bestSplit(const Bins& bins, const BinGrid& grid) {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.scale[axis] == 0) continue;
        float secondCost[kMaxBins];
        Box box = Box::empty();
        uint32_t size = 0;
        for (uint32_t i = grid.count - 1; i > 0; --i) {
            box.grow(bins.box[axis][i]);
            size += bins.size[axis][i];
            secondCost[i] = size ? box.halfArea() * static_cast<float>(size) : kInfinity;
        }
        box = Box::empty(), size = 0;
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
    for (uint32_t i = 0; i < count; ++i) {
        const bool isFirst = grid.bin(refs[i], split.axis) < static_cast<int32_t>(split.bin);
        *(isFirst ? first : second) = refs[i];
        first += isFirst;
        second += !isFirst;
    }
}

Halves placeHalves(const Range& range, uint32_t firstSize, const Box& first, uint32_t secondSize, const Box& second) {
    Halves halves{{{range.spare, range.refs, firstSize, 0, first}, {range.spare, range.refs, secondSize, 0, second}}};
    Range &a = halves.half[0], &b = halves.half[1];
    const uint32_t room = range.slots() - firstSize - secondSize;
    const float share = room > 0 ? a.cost() / (a.cost() + b.cost()) : 0;
    a.room = share > 0 ? std::min(room, static_cast<uint32_t>(static_cast<double>(share) * room)) : 0;
    b.room = room - a.room;
    b.refs += a.slots(), b.spare += a.slots();
    return halves;
}

Halves placeHalves(const Range& range, const Bins& bins, const BinGrid& grid, const Split& split) {
    Box box[2] = {Box::empty(), Box::empty()};
    for (uint32_t i = 0; i < grid.count; ++i) box[i >= split.bin].grow(bins.box[split.axis][i]);
    return placeHalves(range, split.firstSize, box[0], range.size - split.firstSize, box[1]);
}

bool splitBinned(const Range& range, Halves& halves) {
    if (!(range.box.halfArea() > 0)) return false;
    const BinGrid grid(centroidBounds2(range.refs, range.size), range.size);
    Bins bins(grid.count);
    bins.add(grid, range.refs, range.size);
    const Split split = bestSplit(bins, grid);
    if (split.firstSize == 0) return false;
    halves = placeHalves(range, bins, grid, split);
    partition(grid, split, range.refs, range.size, halves.half[0].refs, halves.half[1].refs);
    return true;
}

bool splitSwept(const Range& range, Halves& halves) {
    if (!(range.box.halfArea() > 0)) return false;
    const uint32_t n = range.size;
    uint8_t order[3][kMaxSweepSize];
    sortAlongAxes(range.refs, n, order);
    float bestCost = kInfinity;
    int bestAxis = 0;
    uint32_t firstSize = 0;
    Box firstBox = Box::empty(), secondBox = Box::empty();
    for (int axis = 0; axis < 3; ++axis) {
        const auto ref = [&](uint32_t i) -> const Ref& { return range.refs[order[axis][i]]; };
        if (!(ref(0).center2(axis) < ref(n - 1).center2(axis))) continue;
        Box second[kMaxSweepSize];  // box of the refs from i on
        second[n - 1] = ref(n - 1);
        for (uint32_t i = n - 1; i > 1; --i) {
            second[i - 1] = second[i];
            second[i - 1].grow(ref(i - 1));
        }
        Box first = Box::empty();
        for (uint32_t i = 1; i < n; ++i) {
            first.grow(ref(i - 1));
            const float cost = first.halfArea() * static_cast<float>(i) + second[i].halfArea() * static_cast<float>(n - i);
            if (cost < bestCost) bestCost = cost, bestAxis = axis, firstSize = i, firstBox = first, secondBox = second[i];
        }
    }
    if (firstSize == 0) return false;
    halves = placeHalves(range, firstSize, firstBox, n - firstSize, secondBox);
    Ref* out = halves.half[0].refs;
    for (uint32_t i = 0; i < n; ++i) {
        if (i == firstSize) out = halves.half[1].refs;
        *out++ = range.refs[order[bestAxis][i]];
    }
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
    return {{{range.refs, range.spare, n, 0, boxOf(range.refs, n)},
             {range.refs + n, range.spare + n, range.size - n, range.room, boxOf(range.refs + n, range.size - n)}}};
}

}  // namespace minirtc
