// How the BVH builder divides primitives in two. Every function is a pure function of its input and keeps a defined order, so
// that trees do not depend on threads.
#pragma once
#include <cstring>
#include <limits>

#include "bvh.hpp"

namespace minirtc {

/// A box of four lanes, of which three count: the shape that compilers turn into vector instructions.
struct alignas(16) Box {
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();
    float lo[4] = {kInfinity, kInfinity, kInfinity, kInfinity};
    float hi[4] = {-kInfinity, -kInfinity, -kInfinity, -kInfinity};

    void grow(const Box& b) {
        for (int i = 0; i < 4; ++i) lo[i] = b.lo[i] < lo[i] ? b.lo[i] : lo[i];
        for (int i = 0; i < 4; ++i) hi[i] = b.hi[i] > hi[i] ? b.hi[i] : hi[i];
    }
    float halfArea() const {
        const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
        return x * y + y * z + z * x;
    }
    /// Twice the centre: comparisons do not need the division.
    float center2(int axis) const { return lo[axis] + hi[axis]; }
};

/// The box of a primitive with the primitive's number in the idle lane of `hi`.
struct Ref : Box {
    uint32_t primitive() const {
        uint32_t index;
        std::memcpy(&index, &hi[3], sizeof index);
        return index;
    }
    void setPrimitive(uint32_t index) { std::memcpy(&hi[3], &index, sizeof index); }
};

/// `size` primitives. Splits write to `spare`, of the same size, or sort `refs`; what they return tells where the halves are.
struct Range {
    Ref* refs;
    Ref* spare;
    uint32_t size;
    Box box;
};

struct Halves {
    Range half[2];
};

constexpr uint32_t kMaxBins = 32;
constexpr uint32_t kMaxSweepSize = 8;

/// Divides the space of the centroids into `count` bins along each axis.
struct BinGrid {
    uint32_t count;
    float origin[3];
    float scale[3];  // 0 along an axis that cannot be divided

    BinGrid(const Box& centroids2, uint32_t size);
    uint32_t bin(const Box& b, int axis) const {
        const uint32_t i = static_cast<uint32_t>(static_cast<int32_t>((b.center2(axis) - origin[axis]) * scale[axis]));
        return i < count ? i : count - 1;
    }
};

struct Bins {
    Box box[3][kMaxBins];
    uint32_t size[3][kMaxBins] = {};

    void add(const BinGrid& grid, const Ref* refs, uint32_t count);
    void add(const Bins& other);
    uint32_t sizeBelow(int axis, uint32_t bin) const;
};

/// Between two bins. `cost` is half area times size, summed over the halves: what SAH minimises; infinite if there is no split.
struct Split {
    float cost = Box::kInfinity;
    int axis = 0;
    uint32_t bin = 0;  // the first one of the second half
    uint32_t firstSize = 0;
};

/// The bounds of twice the centres.
Box centroidBounds2(const Ref* refs, uint32_t count);
Split bestSplit(const Bins& bins, const BinGrid& grid);
/// Copies `refs` to `first` or `second` by half, keeping their order.
void partition(const BinGrid& grid, const Split& split, const Ref* refs, uint32_t count, Ref* first, Ref* second);
/// The halves of `range` after a partition into its `spare`.
Halves halvesAfter(const Range& range, const Bins& bins, const BinGrid& grid, const Split& split);

/// The split of least cost between bins. False if none is better than another: centres that agree, a box without area.
bool splitBinned(const Range& range, Halves& halves);
/// The same over every split along an axis, for at most kMaxSweepSize primitives.
bool splitSwept(const Range& range, Halves& halves);
/// Halves of equal size along the axis on which the centres spread most. Works for any input.
Halves splitMedian(const Range& range);

}  // namespace minirtc
