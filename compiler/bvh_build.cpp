// Top-down builder with the surface area heuristic over bins [Wald 2007, "On fast Construction of SAH-based Bounding Volume
// Hierarchies"].
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <type_traits>

#include "bvh_join_pieces.hpp"
#include "bvh_reinsert.hpp"
#include "bvh_spatial.hpp"
#include "bvh_split.hpp"
#include "parallel.hpp"

namespace minirtc {
namespace {

constexpr uint32_t kChunkSize = 8192;     // primitives that a thread takes at once
constexpr uint32_t kMinTaskSize = 1024;   // a smaller subtree is not worth a task of its own
constexpr uint32_t kTasksPerThread = 16;  // so that tasks of unequal cost still end together

// Of splits into pieces, in half areas of the scene.
constexpr float kLeastOverlap = 2e-3f;  // of the halves
constexpr float kLeastGain = 2;         // of a tree that has one piece more for each primitive

/// Room for elements that begin to live when they are written: its pages are first touched by the thread that needs them.
template <typename T>
class Room {
public:
    explicit Room(size_t size) : size_(size), data_(std::allocator<T>().allocate(size)) {}
    ~Room() { std::allocator<T>().deallocate(data_, size_); }
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;
    T* data() { return data_; }
    const T& operator[](size_t i) const { return data_[i]; }
    T& begin(size_t i) { return *new (&data_[i]) T; }

private:
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    size_t size_;
    T* data_;
};

/// A subtree to build over the slots [first, first + range.size) of the leaf order. It may use the nodes [node, node +
/// range.size - 1), as many as it can need, so that subtrees are built without a word to one another.
struct Subtree {
    Range range;
    uint32_t first;
    uint32_t node;
    uint32_t levels;  // inner nodes allowed on a path from here
    BvhChild* reference;
};

class Builder {
public:
    /// `room`: for so many pieces more than primitives. `joinsLeaves`: where that is cheaper; else leaves are of one piece each as far as the bound of
    /// the depth allows.
    Builder(const Geometry& geometry, uint32_t room, ThreadPool& pool, bool joinsLeaves);
    Bvh build();

private:
    void buildTop(const Subtree& subtree);
    float buildSubtree(const Subtree& subtree);
    bool splitParallel(const Range& range, Halves& halves);
    void makeLeaf(const Subtree& subtree);
    void collapse(const Subtree& subtree);
    void makeNode(const Subtree& subtree, const Halves& halves, Subtree (&children)[2]);
    void compact(Bvh& bvh) const;

    const Geometry& geometry_;
    const uint32_t size_;
    const uint32_t slots_;
    SpatialTerms terms_;
    ThreadPool& pool_;
    const bool joinsLeaves_;
    const uint32_t taskSize_;
    Room<Ref> refs_, spare_;
    Room<BvhNode> nodes_;
    std::vector<uint8_t> used_;  // of nodes_
    std::vector<uint32_t> order_;
    std::vector<Subtree> tasks_;
};

uint32_t chunks(uint32_t size) {
    return (size + kChunkSize - 1) / kChunkSize;
}
uint32_t chunkEnd(uint32_t size, size_t chunk) {
    return std::min(size, static_cast<uint32_t>(chunk + 1) * kChunkSize);
}

Aabb toAabb(const Box& b) {
    return {{b.lo[0], b.lo[1], b.lo[2]}, {b.hi[0], b.hi[1], b.hi[2]}};
}

/// True when leaves of `size` primitives fit below `levels` levels of inner nodes.
bool fits(uint32_t size, uint32_t levels) {
    return size <= uint64_t{kMaxLeafSize} << levels;
}

bool fit(const Halves& halves, uint32_t levels) {
    return fits(halves.half[0].size, levels) && fits(halves.half[1].size, levels);
}

Builder::Builder(const Geometry& geometry, uint32_t room, ThreadPool& pool, bool joinsLeaves)
    : geometry_(geometry),
      size_(static_cast<uint32_t>(geometry.primitives.size())),
      slots_(size_ + room),
      pool_(pool),
      joinsLeaves_(joinsLeaves),
      taskSize_(pool_.size() == 1 ? size_ : std::max(kMinTaskSize, size_ / (kTasksPerThread * pool_.size()))),
      refs_(slots_),
      spare_(slots_),
      nodes_(slots_),
      used_(slots_),
      order_(slots_) {}

Bvh Builder::build() {
    std::vector<Box> boxes(chunks(size_), Box::empty());
    pool_.parallelFor(boxes.size(), [&](size_t chunk) {
        for (uint32_t i = static_cast<uint32_t>(chunk) * kChunkSize; i < chunkEnd(size_, chunk); ++i) {
            refs_.begin(i) = Ref(bounds(geometry_.primitives[i]), i);
            boxes[chunk].grow(refs_[i]);
        }
    });
    Box box = Box::empty();
    for (const Box& b : boxes) box.grow(b);

    terms_ = {kLeastOverlap * box.halfArea(), kLeastGain * box.halfArea() / static_cast<float>(size_)};
    BvhChild root;
    buildTop({{refs_.data(), spare_.data(), size_, slots_ - size_, box}, 0, 0, kMaxDepth, &root});
    pool_.parallelFor(tasks_.size(), [&](size_t i) { buildSubtree(tasks_[i]); });

    Bvh bvh;
    if (root.count > 0) {
        bvh.nodes = {{{root, {Aabb(), root.index, root.count}}}};
        bvh.leaves = 1;
    } else {
        compact(bvh);
        bvh.leaves = static_cast<uint32_t>(bvh.nodes.size()) + 1;
    }
    bvh.order = std::move(order_);
    return bvh;
}

/// Splits what is large with all threads at each split, but for pieces, which one makes; the rest becomes tasks.
void Builder::buildTop(const Subtree& subtree) {
    if (subtree.range.size <= taskSize_) {
        tasks_.push_back(subtree);
        return;
    }
    Halves halves;
    const bool found = splitParallel(subtree.range, halves);
    if (found) splitSpatially(geometry_, subtree.range, terms_, halves);
    if (!found || !fit(halves, subtree.levels - 1)) halves = splitMedian(subtree.range);
    Subtree children[2];
    makeNode(subtree, halves, children);
    buildTop(children[0]);
    buildTop(children[1]);
}

bool Builder::splitParallel(const Range& range, Halves& halves) {
    if (!(range.box.halfArea() > 0)) return false;
    const uint32_t n = chunks(range.size);
    const auto sizeOf = [&](size_t chunk) { return chunkEnd(range.size, chunk) - static_cast<uint32_t>(chunk) * kChunkSize; };
    std::vector<Box> centroids2(n);
    pool_.parallelFor(n, [&](size_t i) { centroids2[i] = centroidBounds2(range.refs + i * kChunkSize, sizeOf(i)); });
    for (const Box& b : centroids2) centroids2[0].grow(b);

    const BinGrid grid(centroids2[0], range.size);
    std::vector<Bins> bins(n, Bins(grid.count));
    pool_.parallelFor(n, [&](size_t i) { bins[i].add(grid, range.refs + i * kChunkSize, sizeOf(i)); });
    Bins sum(grid.count);
    for (const Bins& b : bins) sum.add(b);
    const Split split = bestSplit(sum, grid);
    if (split.firstSize == 0) return false;

    halves = placeHalves(range, sum, grid, split);
    std::vector<uint32_t> firstBelow(n + 1);  // primitives of the first half in the chunks before
    for (uint32_t i = 0; i < n; ++i) firstBelow[i + 1] = firstBelow[i] + bins[i].sizeBelow(split.axis, split.bin);
    pool_.parallelFor(n, [&](size_t i) {
        const uint32_t secondBelow = static_cast<uint32_t>(i) * kChunkSize - firstBelow[i];
        partition(grid, split, range.refs + i * kChunkSize, sizeOf(i), halves.half[0].refs + firstBelow[i],
                  halves.half[1].refs + secondBelow);
    });
    return true;
}

/// Returns the cost of the subtree times its half area. A leaf is made where the subtree turns out to be no cheaper.
float Builder::buildSubtree(const Subtree& subtree) {
    const Range& range = subtree.range;
    const float leafCost = range.box.halfArea() * static_cast<float>(range.size);
    if (range.size == 1 || subtree.levels == 0) {
        makeLeaf(subtree);
        return leafCost;
    }
    Halves halves;
    const bool found = range.size <= kMaxSweepSize ? splitSwept(range, halves) : splitBinned(range, halves);
    if (found) splitSpatially(geometry_, range, terms_, halves);
    if (!found || !fit(halves, subtree.levels - 1)) halves = splitMedian(range);
    Subtree children[2];
    makeNode(subtree, halves, children);
    const float firstCost = buildSubtree(children[0]);
    const float cost = range.box.halfArea() + firstCost + buildSubtree(children[1]);
    if (!joinsLeaves_ || range.size > kMaxLeafSize || cost < leafCost) return cost;
    collapse(subtree);
    return leafCost;
}

void Builder::makeLeaf(const Subtree& subtree) {
    const Range& range = subtree.range;
    for (uint32_t i = 0; i < range.size; ++i) order_[subtree.first + i] = range.refs[i].primitive();
    *subtree.reference = {toAabb(range.box), subtree.first, range.size};
}

/// Makes a leaf of a finished subtree.
void Builder::collapse(const Subtree& subtree) {
    std::fill_n(used_.begin() + subtree.node, subtree.range.slots() - 1, uint8_t{0});
    *subtree.reference = {toAabb(subtree.range.box), subtree.first, subtree.range.size};
}

void Builder::makeNode(const Subtree& subtree, const Halves& halves, Subtree (&children)[2]) {
    BvhNode& node = nodes_.begin(subtree.node);
    const uint32_t n = halves.half[0].slots();
    children[0] = {halves.half[0], subtree.first, subtree.node + 1, subtree.levels - 1, &node.child[0]};
    children[1] = {halves.half[1], subtree.first + n, subtree.node + n, subtree.levels - 1, &node.child[1]};
    used_[subtree.node] = 1;
    *subtree.reference = {toAabb(subtree.range.box), subtree.node, 0};
}

/// Copies the nodes in use, closing the gaps between subtrees.
void Builder::compact(Bvh& bvh) const {
    std::vector<uint32_t> place(slots_);
    uint32_t count = 0;
    for (uint32_t i = 0; i < slots_; ++i) {
        place[i] = count;
        count += used_[i];
    }
    bvh.nodes.reserve(count);
    for (uint32_t i = 0; i < slots_; ++i) {
        if (!used_[i]) continue;
        bvh.nodes.push_back(nodes_[i]);
        for (BvhChild& child : bvh.nodes.back().child)
            if (child.count == 0) child.index = place[child.index];
    }
}

void measure(Bvh& bvh) {
    std::vector<uint8_t> depth(bvh.nodes.size(), 1);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        bvh.depth = std::max<uint32_t>(bvh.depth, depth[i]);
        for (const BvhChild& child : bvh.nodes[i].child) {
            if (child.count == 0) depth[child.index] = static_cast<uint8_t>(depth[i] + 1);
        }
    }
    bvh.sahCost = sahCost(bvh);
}

/// How many pieces to make room for, before those are given up that do not pay.
uint32_t roomForPieces(const Bvh& whole, double mostBytes) {
    return bytesOf(whole.order.size(), whole.nodes.size()) < mostBytes ? static_cast<uint32_t>(whole.order.size()) : 0;
}

Bvh buildHigh(const Geometry& geometry, uint32_t room, double mostBytes, ThreadPool& pool) {
    Bvh pieces = Builder(geometry, room, pool, false).build();  // first, so that the builder's memory is free again
    LinkedTree tree(std::move(pieces));
    if (room > 0) joinPieces(tree, mostBytes);
    reinsertSubtrees(tree, pool);
    if (room > 0) joinPieces(tree, mostBytes);  // moves change which subtrees become leaves
    Bvh bvh = tree.toBvh();
    measure(bvh);
    return bvh;
}

double halfArea(const Aabb& box) {
    const glm::dvec3 d = glm::max(glm::dvec3(box.hi) - glm::dvec3(box.lo), glm::dvec3(0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// The largest float not above a - b.
float subtractDown(float a, float b) {
    const float difference = a - b;
    const float bRounded = a - difference;  // TwoSum [Knuth 1969]: the rounding error, exactly
    const float error = (a - (difference + bRounded)) + (bRounded - b);
    return error < 0 ? std::nextafter(difference, -kInfinity) : difference;
}

}  // namespace

Aabb bounds(const Primitive& primitive) {
    Aabb box;
    if (!primitive.isSphere) {
        for (const glm::vec3& p : primitive.p) box.grow(p);
        return box;
    }
    const float radius = primitive.p[1].x;
    for (int i = 0; i < 3; ++i) {
        box.lo[i] = subtractDown(primitive.p[0][i], radius);
        box.hi[i] = -subtractDown(-primitive.p[0][i], radius);
    }
    return box;
}

double sahCost(const Bvh& bvh) {
    if (bvh.nodes.empty()) return 0;
    Aabb root = bvh.nodes[0].child[0].box;
    root.grow(bvh.nodes[0].child[1].box);
    double cost = halfArea(root);
    for (const BvhNode& node : bvh.nodes)
        for (const BvhChild& child : node.child) cost += halfArea(child.box) * std::max(child.count, 1u);
    return halfArea(root) > 0 ? cost / halfArea(root) : 0;
}

double bytesOf(size_t references, size_t nodes) {
    return 48 * static_cast<double>(references) + 32 * static_cast<double>(nodes);
}

Bvh buildBvh(const Geometry& geometry, unsigned threads, BvhQuality quality, double bytesEach) {
    const auto start = std::chrono::steady_clock::now();
    if (geometry.primitives.empty()) return {};
    ThreadPool pool(threads);
    Bvh bvh = Builder(geometry, 0, pool, true).build();
    measure(bvh);
    if (quality == BvhQuality::high && geometry.primitives.size() > kMaxLeafSize) {
        const double mostBytes = bytesEach * static_cast<double>(bvh.order.size());
        Bvh better = buildHigh(geometry, roomForPieces(bvh, mostBytes), mostBytes, pool);
        if (better.order.size() > bvh.order.size() && bytesOf(better.order.size(), better.nodes.size()) > mostBytes)
            better = buildHigh(geometry, 0, mostBytes, pool);
        if (better.sahCost < bvh.sahCost) bvh = std::move(better);  // but where the bound of the depth leaves no room
    }
    bvh.buildMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

}  // namespace minirtc
