#include "bvh_spatial.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

constexpr uint32_t kChunkSize = 8192;        // primitives that a thread takes at once
constexpr int kGridBits = 20;                // planes to cut at: the halves, quarters, ... of the scene
constexpr float kLeastGain = 0.1f;           // of a cut, in mean areas of the primitives' boxes
constexpr double kLeastPieces = 1.0 / 1024;  // a primitive, or another build is not worth it

/// Two boxes in place of one.
struct Cut {
    float worth = 0;  // the half area that it saves, times the square of the plane's spacing
    Aabb side[2];
};

/// Spacing: between planes as coarse as it, of the scene. Coarse planes are where the builder divides all that is there.
struct Plane {
    float position;
    float spacing;
};

/// The coarsest plane of the grid that runs through the box, if any.
bool planeThrough(const Aabb& scene, const Aabb& box, int axis, Plane& plane) {
    const double origin = static_cast<double>(scene.lo[axis]);
    const double cell = (static_cast<double>(scene.hi[axis]) - origin) / (1 << kGridBits);
    if (!(cell > 0)) return false;
    const auto first = static_cast<uint32_t>((static_cast<double>(box.lo[axis]) - origin) / cell);
    const auto last = static_cast<uint32_t>((static_cast<double>(box.hi[axis]) - origin) / cell);
    uint32_t below = first ^ last;  // becomes the bits below the first one in which they differ
    for (uint32_t shift = 1; shift < 32; shift *= 2) below |= below >> shift;
    plane.position = static_cast<float>(origin + cell * (last & ~(below >> 1)));
    plane.spacing = static_cast<float>(below + 1) / (1 << kGridBits);
    return box.lo[axis] < plane.position && plane.position < box.hi[axis];
}

/// The smallest box of floats with the point in it: one step more than rounding takes.
void growAround(Aabb& box, const glm::dvec3& point) {
    for (int i = 0; i < 3; ++i) {
        const auto nearest = static_cast<float>(point[i]);
        box.lo[i] = std::min(box.lo[i], std::nextafter(nearest, -INFINITY));
        box.hi[i] = std::max(box.hi[i], std::nextafter(nearest, INFINITY));
    }
}

/// Of a triangle's parts on either side of a plane, as far as they lie in `box`.
void boxesOfSides(const Primitive& triangle, const Aabb& box, int axis, float plane, Aabb (&side)[2]) {
    side[0] = side[1] = Aabb();
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 &a = triangle.p[i], &b = triangle.p[(i + 1) % 3];
        if (a[axis] <= plane) side[0].grow(a);
        if (a[axis] >= plane) side[1].grow(a);
        if ((a[axis] < plane) == (b[axis] < plane)) continue;
        const glm::dvec3 from(a), edge = glm::dvec3(b) - from;
        const glm::dvec3 point = from + edge * ((static_cast<double>(plane) - from[axis]) / edge[axis]);
        for (Aabb& one : side) growAround(one, point);
    }
    for (Aabb& one : side) one.lo = glm::max(one.lo, box.lo), one.hi = glm::min(one.hi, box.hi);
    side[0].hi[axis] = std::min(side[0].hi[axis], plane);
    side[1].lo[axis] = std::max(side[1].lo[axis], plane);
}

bool isEmpty(const Aabb& box) {
    return box.lo.x > box.hi.x || box.lo.y > box.hi.y || box.lo.z > box.hi.z;
}

/// Of worth 0 where none saves more than `leastGain`.
Cut bestCut(const Primitive& primitive, const Aabb& box, const Aabb& scene, float leastGain) {
    Cut best;
    if (primitive.isSphere) return best;
    for (int axis = 0; axis < 3; ++axis) {
        Plane plane;
        if (!planeThrough(scene, box, axis, plane)) continue;
        Cut cut;
        boxesOfSides(primitive, box, axis, plane.position, cut.side);
        if (isEmpty(cut.side[0]) || isEmpty(cut.side[1])) continue;
        const float gain = box.halfArea() - cut.side[0].halfArea() - cut.side[1].halfArea();
        cut.worth = gain > leastGain ? gain * plane.spacing * plane.spacing : 0;
        if (cut.worth > best.worth) best = cut;
    }
    return best;
}

/// A piece that may be cut.
struct Candidate {
    float worth;
    uint32_t piece;
    bool operator<(const Candidate& other) const { return worth != other.worth ? worth < other.worth : piece > other.piece; }
};

struct Pieces {
    std::vector<Piece> all;
    Aabb scene;
    double area = 0;  // of all boxes
};

Pieces wholePrimitives(const Geometry& geometry, ThreadPool& pool) {
    const size_t count = geometry.primitives.size(), chunks = (count + kChunkSize - 1) / kChunkSize;
    Pieces pieces;
    pieces.all.resize(count);
    std::vector<Pieces> parts(chunks);
    pool.parallelFor(chunks, [&](size_t chunk) {
        for (size_t i = chunk * kChunkSize; i < std::min(count, (chunk + 1) * kChunkSize); ++i) {
            pieces.all[i] = {bounds(geometry.primitives[i]), static_cast<uint32_t>(i)};
            parts[chunk].scene.grow(pieces.all[i].box);
            parts[chunk].area += static_cast<double>(pieces.all[i].box.halfArea());
        }
    });
    for (const Pieces& part : parts) pieces.scene.grow(part.scene), pieces.area += part.area;
    return pieces;
}

/// As a heap.
std::vector<Candidate> candidatesAmong(const Pieces& pieces, const Geometry& geometry, float leastGain, ThreadPool& pool) {
    const size_t count = pieces.all.size(), chunks = (count + kChunkSize - 1) / kChunkSize;
    std::vector<std::vector<Candidate>> parts(chunks);
    pool.parallelFor(chunks, [&](size_t chunk) {
        for (size_t i = chunk * kChunkSize; i < std::min(count, (chunk + 1) * kChunkSize); ++i) {
            if (!(pieces.all[i].box.halfArea() > leastGain)) continue;
            const Cut cut = bestCut(geometry.primitives[i], pieces.all[i].box, pieces.scene, leastGain);
            if (cut.worth > 0) parts[chunk].push_back({cut.worth, static_cast<uint32_t>(i)});
        }
    });
    std::vector<Candidate> heap;
    for (const std::vector<Candidate>& part : parts) heap.insert(heap.end(), part.begin(), part.end());
    std::make_heap(heap.begin(), heap.end());
    return heap;
}

}  // namespace

std::vector<Piece> splitPrimitives(const Geometry& geometry, double share, ThreadPool& pool) {
    Pieces pieces = wholePrimitives(geometry, pool);
    const auto count = static_cast<double>(pieces.all.size());
    const auto most = static_cast<size_t>(count * (1 + share));
    const float leastGain = kLeastGain * static_cast<float>(pieces.area / count);
    std::vector<Candidate> heap = candidatesAmong(pieces, geometry, leastGain, pool);
    const auto offer = [&](uint32_t piece) {
        const Piece& one = pieces.all[piece];
        const Cut cut = bestCut(geometry.primitives[one.primitive], one.box, pieces.scene, leastGain);
        if (!(cut.worth > 0)) return;
        heap.push_back({cut.worth, piece});
        std::push_heap(heap.begin(), heap.end());
    };
    while (!heap.empty() && pieces.all.size() < most) {
        std::pop_heap(heap.begin(), heap.end());
        const uint32_t piece = heap.back().piece;
        heap.pop_back();
        const Piece whole = pieces.all[piece];
        const Cut cut = bestCut(geometry.primitives[whole.primitive], whole.box, pieces.scene, leastGain);
        pieces.all[piece].box = cut.side[0];
        pieces.all.push_back({cut.side[1], whole.primitive});
        offer(piece);
        offer(static_cast<uint32_t>(pieces.all.size() - 1));
    }
    if (static_cast<double>(pieces.all.size()) - count < kLeastPieces * count) return {};
    return std::move(pieces.all);
}

}  // namespace minirtc
