// How the BVH builder divides primitives in two. Every function is a pure function of its input and keeps a defined order, so
// that trees do not depend on threads.
#pragma once
#include <limits>

#include "bvh.hpp"

namespace minirtc {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Four numbers that compilers handle at once; GCC's and Clang's notation for what the hardware has.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

/// A box of four lanes, of which three count.
struct Box {
    Float4 lo;
    Float4 hi;

    static Box empty() { return {Float4{} + kInfinity, Float4{} - kInfinity}; }
    void grow(const Box& b) {
        lo = b.lo < lo ? b.lo : lo;
        hi = b.hi > hi ? b.hi : hi;
    }
    float halfArea() const {
        const Float4 d = hi - lo;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
    /// Twice the centre: comparisons do not need the division.
    Float4 center2() const { return lo + hi; }
    float center2(int axis) const { return lo[axis] + hi[axis]; }
};

inline Box joined(Box a, const Box& b) {
    a.grow(b);
    return a;
}

/// The box of a primitive. The idle lanes hold the halves of the primitive's number, so they may pass through arithmetic.
struct Ref : Box {
    Ref() = default;
    Ref(const Aabb& box, uint32_t primitive)
        : Box{{box.lo.x, box.lo.y, box.lo.z, static_cast<float>(primitive >> 16)},
              {box.hi.x, box.hi.y, box.hi.z, static_cast<float>(primitive & 0xffffu)}} {}
    uint32_t primitive() const { return static_cast<uint32_t>(lo[3]) << 16 | static_cast<uint32_t>(hi[3]); }
};

/// `size` primitives or pieces of them, and after them `room` for more pieces. Splits write to `spare`, of the same size, or sort `refs`; what
/// they return tells where the halves are.
struct Range {
    Ref* refs;
    Ref* spare;
    uint32_t size;
    uint32_t room;
    Box box;
    uint32_t slots() const { return size + room; }
    /// What testing all of them costs, times the half area around.
    float cost() const { return box.halfArea() * static_cast<float>(size); }
};

struct Halves {
    Range half[2];
};

constexpr uint32_t kMaxBins = 32;
constexpr uint32_t kMaxSweepSize = 8;

/// Divides the space of the centroids into `count` bins along each axis.
struct BinGrid {
    uint32_t count;
    Float4 origin;
    Float4 scale;  // 0 along an axis that cannot be divided, and in the idle lane

    BinGrid(const Box& centroids2, uint32_t size);
    // Comparing turns the NaN of centres at infinity into 0.
    Int4 bins(const Box& b) const {
        const Float4 position = (b.center2() - origin) * scale;
        return __builtin_convertvector(position > 0 ? position : Float4{}, Int4);
    }
    int32_t bin(const Box& b, int axis) const {
        const float position = (b.center2(axis) - origin[axis]) * scale[axis];
        return static_cast<int32_t>(position > 0 ? position : 0);
    }
};

/// What lies in the bins of a grid: one set an axis. Bins from `count` on are not there.
struct Bins {
    Box box[3][kMaxBins];
    uint32_t size[3][kMaxBins];
    uint32_t count;

    explicit Bins(uint32_t count);
    void add(const BinGrid& grid, const Ref* refs, uint32_t refCount);
    void add(const Bins& other);
    uint32_t sizeBelow(int axis, uint32_t bin) const;
};

/// Between two bins. `cost` is half area times size, summed over the halves: what SAH minimises; infinite if there is no split.
struct Split {
    float cost = kInfinity;
    int axis = 0;
    uint32_t bin = 0;  // the first one of the second half
    uint32_t firstSize = 0;
};

/// The bounds of twice the centres.
Box centroidBounds2(const Ref* refs, uint32_t count);
Split bestSplit(const Bins& bins, const BinGrid& grid);
/// Copies `refs` to `first` or `second` by half, keeping their order.
void partition(const BinGrid& grid, const Split& split, const Ref* refs, uint32_t count, Ref* first, Ref* second);
/// Where halves of these sizes belong in the `spare` of a range: each with the share of the room that it has of the cost.
Halves placeHalves(const Range& range, uint32_t firstSize, const Box& first, uint32_t secondSize, const Box& second);
/// The same for the halves of a split between bins.
Halves placeHalves(const Range& range, const Bins& bins, const BinGrid& grid, const Split& split);

/// The split of least cost between bins. False if none is better than another: centres that agree, a box without area.
bool splitBinned(const Range& range, Halves& halves);
/// The same over every split along an axis, for at most kMaxSweepSize primitives.
bool splitSwept(const Range& range, Halves& halves);
/// Halves of equal size, the second with all the room, along the axis on which the centres spread most. Works for any input.
Halves splitMedian(const Range& range);

}  // namespace minirtc
