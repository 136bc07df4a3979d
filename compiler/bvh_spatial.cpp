#include "bvh_spatial.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace minirtc {
namespace {

constexpr uint32_t kMostBins = 16;

Float4 smaller(const Float4& a, const Float4& b) {
    return a < b ? a : b;
}

Float4 larger(const Float4& a, const Float4& b) {
    return a > b ? a : b;
}

Float4 toFloat4(const glm::vec3& p) {
    return Float4{p.x, p.y, p.z, 0};
}

Box intersection(const Box& a, const Box& b) {
    return {larger(a.lo, b.lo), smaller(a.hi, b.hi)};
}

/// Of three lanes.
bool isEmpty(const Box& box) {
    return box.lo[0] > box.hi[0] || box.lo[1] > box.hi[1] || box.lo[2] > box.hi[2];
}

/// Around the point between `a` and `b` on a plane, by more than rounding can take.
Box aroundCrossing(const Float4& a, const Float4& b, int axis, float plane) {
    constexpr float kRounding = 0x1p-20f;
    const Float4 point = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
    const Float4 error = larger(larger(a, -a), larger(b, -b)) * kRounding + std::numeric_limits<float>::min();
    return {point - error, point + error};
}

/// Around what of a triangle lies on either side of a plane.
void boundSides(const Primitive& triangle, int axis, float plane, Box (&side)[2]) {
    side[0] = side[1] = Box::empty();
    const Float4 corner[3] = {toFloat4(triangle.p[0]), toFloat4(triangle.p[1]), toFloat4(triangle.p[2])};
    for (int i = 0; i < 3; ++i) {
        const Float4 &a = corner[i], &b = corner[(i + 1) % 3];
        if (a[axis] <= plane) side[0].grow({a, a});
        if (a[axis] >= plane) side[1].grow({a, a});
        if ((a[axis] < plane) == (b[axis] < plane)) continue;
        const Box crossing = aroundCrossing(a, b, axis, plane);
        for (Box& one : side) one.grow(crossing);
    }
}

/// Boxes of what of a triangle's piece lies on either side of a plane through its box.
void cut(const Geometry& geometry, const Ref& ref, int axis, float plane, Ref (&piece)[2]) {
    Box side[2];
    boundSides(geometry.primitives[ref.primitive()], axis, plane, side);
    piece[0] = piece[1] = ref;
    piece[0].hi[axis] = piece[1].lo[axis] = plane;
    for (int i = 0; i < 2; ++i) {
        Ref smallest = piece[i];  // keeps the number, in the idle lanes
        for (int k = 0; k < 3; ++k) {
            smallest.lo[k] = std::max(smallest.lo[k], side[i].lo[k]);
            smallest.hi[k] = std::min(smallest.hi[k], side[i].hi[k]);
        }
        if (!isEmpty(smallest)) piece[i] = smallest;
    }
}

/// A sphere stays whole, on the side of its centre.
bool isSphere(const Geometry& geometry, const Ref& ref) {
    return geometry.primitives[ref.primitive()].isSphere;
}

float centerOf(const Ref& ref, int axis) {
    return 0.5f * ref.center2(axis);
}

/// Planes at equal distances along an axis, and what lies between them.
struct Slabs {
    int axis;
    uint32_t count;
    float origin, width, perWidth;
    Box box[kMostBins];
    uint32_t first[kMostBins] = {}, last[kMostBins] = {};  // refs by the first, the last one that they reach

    Slabs(const Range& range, int along)
        : axis(along),
          count(std::min(kMostBins, 4 + range.size / 4)),
          origin(range.box.lo[axis]),
          width((range.box.hi[axis] - origin) / static_cast<float>(count)),
          perWidth(1 / width) {
        std::fill_n(box, count, Box::empty());
    }
    bool areThere() const { return std::isfinite(width) && std::isfinite(perWidth); }
    float plane(uint32_t slab) const { return origin + width * static_cast<float>(slab); }
    /// But for rounding.
    uint32_t near(float x) const {
        const float position = (x - origin) * perWidth;
        return std::min(static_cast<uint32_t>(position > 0 ? position : 0), count - 1);
    }
    /// So that a plane i is above `x` where, and only where, i > firstAt(x), and below it where i <= lastAt(x).
    uint32_t firstAt(float x) const {
        uint32_t slab = near(x);
        while (slab > 0 && x < plane(slab)) --slab;
        while (slab + 1 < count && !(x < plane(slab + 1))) ++slab;
        return slab;
    }
    uint32_t lastAt(float x) const {
        uint32_t slab = near(x);
        while (slab > 0 && !(x > plane(slab))) --slab;
        while (slab + 1 < count && x > plane(slab + 1)) ++slab;
        return slab;
    }
    void add(const Geometry& geometry, const Ref& ref) {
        uint32_t from = firstAt(ref.lo[axis]), to = std::max(from, lastAt(ref.hi[axis]));
        if (from < to && isSphere(geometry, ref)) from = to = firstAt(centerOf(ref, axis));
        Ref rest = ref;
        for (uint32_t i = from; i < to; ++i) {
            if (!(rest.lo[axis] < plane(i + 1) && plane(i + 1) < rest.hi[axis])) continue;
            Ref piece[2];
            cut(geometry, rest, axis, plane(i + 1), piece);
            box[i].grow(piece[0]);
            rest = piece[1];
        }
        box[to].grow(rest);
        ++first[from], ++last[to];
    }
};

float costOf(const Box& box, uint32_t size) {
    return box.halfArea() * static_cast<float>(size);
}

/// Sizes and boxes of what is on the sides of a plane, with a piece of each ref that crosses it on both.
struct Plane {
    float cost = kInfinity;
    int axis = -1;
    float position = 0;
    uint32_t size[2] = {};
    Box box[2];
};

/// A further piece costs `penalty`.
void findBetter(const Slabs& slabs, const Range& range, float penalty, Plane& best) {
    Box second[kMostBins];
    uint32_t secondSize[kMostBins];
    Box box = Box::empty();
    uint32_t size = 0;
    for (uint32_t i = slabs.count - 1; i > 0; --i) {
        box.grow(slabs.box[i]), size += slabs.last[i];
        second[i] = box, secondSize[i] = size;
    }
    box = Box::empty(), size = 0;
    for (uint32_t i = 1; i < slabs.count; ++i) {
        box.grow(slabs.box[i - 1]), size += slabs.first[i - 1];
        const uint32_t pieces = size + secondSize[i] - range.size;
        if (size == 0 || secondSize[i] == 0 || pieces > range.room) continue;
        const float cost = costOf(box, size) + costOf(second[i], secondSize[i]) + penalty * static_cast<float>(pieces);
        if (cost < best.cost) best = {cost, slabs.axis, slabs.plane(i), {size, secondSize[i]}, {box, second[i]}};
    }
}

/// The side where a ref that crosses the plane costs less whole than in two; -1 where none is.
int wholeSide(const Ref& ref, float penalty, Plane& plane) {
    float cost[2];
    Box box[2] = {plane.box[0], plane.box[1]};
    for (int i = 0; i < 2; ++i) {
        box[i].grow(ref);
        const int other = 1 - i;
        cost[i] =
            plane.size[other] > 1 ? costOf(box[i], plane.size[i]) + costOf(plane.box[other], plane.size[other] - 1) : kInfinity;
    }
    const int side = cost[1] < cost[0];
    if (!(cost[side] < costOf(plane.box[0], plane.size[0]) + costOf(plane.box[1], plane.size[1]) + penalty)) return -1;
    plane.box[side] = box[side];
    --plane.size[1 - side];
    return side;
}

/// Into `spare`: the first half from its front, the second from its back.
Halves divide(const Geometry& geometry, const Range& range, float penalty, Plane plane) {
    Ref *front = range.spare, *back = range.spare + range.slots();
    Box box[2] = {Box::empty(), Box::empty()};
    const auto put = [&](int side, const Ref& ref) {
        box[side].grow(ref);
        *(side == 0 ? front++ : --back) = ref;
    };
    for (uint32_t i = 0; i < range.size; ++i) {
        const Ref& ref = range.refs[i];
        if (!(ref.lo[plane.axis] < plane.position && plane.position < ref.hi[plane.axis])) {
            put(ref.lo[plane.axis] < plane.position ? 0 : 1, ref);
        } else if (isSphere(geometry, ref)) {
            put(centerOf(ref, plane.axis) < plane.position ? 0 : 1, ref);
        } else if (const int side = wholeSide(ref, penalty, plane); side >= 0) {
            put(side, ref);
        } else {
            Ref piece[2];
            cut(geometry, ref, plane.axis, plane.position, piece);
            put(0, piece[0]), put(1, piece[1]);
        }
    }
    Ref* const end = range.spare + range.slots();
    const Halves halves =
        placeHalves(range, static_cast<uint32_t>(front - range.spare), box[0], static_cast<uint32_t>(end - back), box[1]);
    std::memmove(halves.half[1].refs, back, halves.half[1].size * sizeof(Ref));
    return halves;
}

}  // namespace

void splitSpatially(const Geometry& geometry, const Range& range, const SpatialTerms& terms, Halves& halves) {
    const Range &a = halves.half[0], &b = halves.half[1];
    const Box overlap = intersection(a.box, b.box);
    if (range.room == 0 || isEmpty(overlap) || !(overlap.halfArea() > terms.leastOverlap)) return;
    // A subtree costs about 2 log2(size) times its area, rather than size times.
    const auto size = static_cast<float>(range.size);
    const float penalty = terms.leastGain * size / (2 * std::log2(size));
    Plane best;
    best.cost = a.cost() + b.cost();
    for (int axis = 0; axis < 3; ++axis) {
        Slabs slabs(range, axis);
        if (!slabs.areThere()) continue;
        for (uint32_t i = 0; i < range.size; ++i) slabs.add(geometry, range.refs[i]);
        findBetter(slabs, range, penalty, best);
    }
    if (best.axis >= 0) halves = divide(geometry, range, penalty, best);
}

}  // namespace minirtc
