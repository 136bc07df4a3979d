#include "bvh_reinsert.hpp"

#include <algorithm>

#include "bvh_split.hpp"

namespace minirtc {
namespace {

constexpr uint32_t kNoNode = 0xffffffffu;
constexpr uint32_t kRoot = 0;
constexpr uint32_t kStride = 2;  // of all nodes, one in so many is tried in a round
constexpr uint32_t kMostRounds = 16;
constexpr double kLeastImprovement = 1e-3;  // of the cost over kStride rounds, or it is not worth another
constexpr uint32_t kMostPlaces = 100;  // that a search looks at: enough for surfaces; where everything overlaps it would be all
constexpr uint32_t kChunkSize = 256;   // nodes that a thread takes at once

/// A leaf where `height` is 0: then the children are its first slot and its size.
struct Node {
    Box box;
    float area;
    uint32_t parent;
    uint32_t child[2];
    uint32_t height;
    bool isLeaf() const { return height == 0; }
};

struct Move {
    float gain = 0;  // of area
    uint32_t node = kNoNode;
    uint32_t target = kNoNode;  // becomes the sibling
    bool operator<(const Move& other) const { return gain != other.gain ? gain > other.gain : node < other.node; }
};

Box joined(Box a, const Box& b) {
    a.grow(b);
    return a;
}

class Reinserter {
public:
    Reinserter(const Bvh& bvh, ThreadPool& pool);
    void improve();
    Bvh result();

private:
    uint32_t add(const BvhChild& child, uint32_t parent);
    uint32_t sibling(uint32_t node) const;
    Move bestMove(uint32_t node) const;
    void searchSubtree(uint32_t start, float gain, Move& best, uint32_t& placesLeft) const;
    std::vector<Move> findMoves(uint32_t round) const;
    double apply(const Move& move);
    double detach(uint32_t node);
    double attach(uint32_t node, uint32_t target);
    double refit(uint32_t node);
    bool mayAttach(uint32_t node, uint32_t target) const;
    void measureLeaves();
    BvhChild emit(uint32_t node);
    void emitPrimitives(uint32_t node, uint32_t leafStart);

    const Bvh& bvh_;
    ThreadPool& pool_;
    std::vector<Node> nodes_;
    std::vector<uint32_t> size_;     // primitives below
    std::vector<uint8_t> isJoined_;  // becomes a leaf
    Bvh out_;
};

Reinserter::Reinserter(const Bvh& bvh, ThreadPool& pool) : bvh_(bvh), pool_(pool) {
    nodes_.reserve(2 * bvh.nodes.size() + 1);
    BvhChild root;
    root.box = bvh.nodes[0].child[0].box;
    root.box.grow(bvh.nodes[0].child[1].box);
    add(root, kNoNode);
}

/// The subtree of `child`, whose depth is bounded.
uint32_t Reinserter::add(const BvhChild& child, uint32_t parent) {
    const auto place = static_cast<uint32_t>(nodes_.size());
    const Ref box(child.box, 0);
    nodes_.push_back({box, box.halfArea(), parent, {child.index, child.count}, 0});
    if (child.count > 0) return place;
    for (int i = 0; i < 2; ++i) {
        const uint32_t below = add(bvh_.nodes[child.index].child[i], place);
        nodes_[place].child[i] = below;
        nodes_[place].height = std::max(nodes_[place].height, nodes_[below].height + 1);
    }
    return place;
}

uint32_t Reinserter::sibling(uint32_t node) const {
    const Node& parent = nodes_[nodes_[node].parent];
    return parent.child[parent.child[0] == node];
}

/// Without the node its parent goes and all boxes on the way up shrink: what the places under each of these can gain grows on the way.
Move Reinserter::bestMove(uint32_t node) const {
    Move best;
    best.node = node;
    uint32_t pivot = nodes_[node].parent;
    if (pivot == kNoNode || pivot == kRoot) return best;
    float gain = nodes_[pivot].area;
    Box rest = nodes_[sibling(node)].box;
    uint32_t placesLeft = kMostPlaces;
    searchSubtree(sibling(node), gain, best, placesLeft);
    while (pivot != kRoot && placesLeft > 0) {
        const uint32_t aside = sibling(pivot);
        searchSubtree(aside, gain, best, placesLeft);
        rest.grow(nodes_[aside].box);
        pivot = nodes_[pivot].parent;
        gain += nodes_[pivot].area - rest.halfArea();
    }
    return best;
}

/// `gain`: what leaving gains. Boxes around a place grow, and its new parent costs at least the area of the node: where that is too much
/// already, nothing below is better.
void Reinserter::searchSubtree(uint32_t start, float gain, Move& best, uint32_t& placesLeft) const {
    struct Place {
        uint32_t node;
        float gain;
    };
    const Box& box = nodes_[best.node].box;
    const float area = nodes_[best.node].area;
    Place stack[kMaxDepth + 2];
    int level = 0;
    stack[level++] = {start, gain};
    while (level > 0 && placesLeft > 0) {
        const Place place = stack[--level];
        if (!(place.gain - area > best.gain)) continue;
        --placesLeft;
        const Node& node = nodes_[place.node];
        const float around = joined(node.box, box).halfArea();
        if (place.gain - around > best.gain) best.gain = place.gain - around, best.target = place.node;
        const float below = place.gain - (around - node.area);
        if (node.isLeaf() || !(below - area > best.gain)) continue;
        stack[level++] = {node.child[1], below};
        stack[level++] = {node.child[0], below};
    }
}

std::vector<Move> Reinserter::findMoves(uint32_t round) const {
    const auto count = static_cast<uint32_t>(nodes_.size()) / kStride;
    std::vector<Move> moves(count);
    pool_.parallelFor((count + kChunkSize - 1) / kChunkSize, [&](size_t chunk) {
        const auto begin = static_cast<uint32_t>(chunk) * kChunkSize;
        for (uint32_t i = begin; i < std::min(count, begin + kChunkSize); ++i) moves[i] = bestMove(i * kStride + round % kStride);
    });
    moves.erase(std::remove_if(moves.begin(), moves.end(), [](const Move& m) { return m.target == kNoNode; }), moves.end());
    std::sort(moves.begin(), moves.end());
    return moves;
}

/// Boxes and heights from `node` up. Returns by how much the areas grow.
double Reinserter::refit(uint32_t node) {
    double growth = 0;
    for (; node != kNoNode; node = nodes_[node].parent) {
        Node& n = nodes_[node];
        const Node &a = nodes_[n.child[0]], &b = nodes_[n.child[1]];
        n.box = joined(a.box, b.box);
        const float area = n.box.halfArea();
        growth += static_cast<double>(area) - static_cast<double>(n.area);
        n.area = area;
        n.height = std::max(a.height, b.height) + 1;
    }
    return growth;
}

/// Takes a node with its parent out of the tree; the parent stays its parent.
double Reinserter::detach(uint32_t node) {
    const uint32_t parent = nodes_[node].parent, other = sibling(node), above = nodes_[parent].parent;
    Node& top = nodes_[above];
    top.child[top.child[1] == parent] = other;
    nodes_[other].parent = above;
    const double area = static_cast<double>(nodes_[parent].area);
    nodes_[parent].area = 0;
    return refit(above) - area;
}

/// The reverse: its parent goes between `target` and what is above that.
double Reinserter::attach(uint32_t node, uint32_t target) {
    const uint32_t parent = nodes_[node].parent, above = nodes_[target].parent;
    Node& top = nodes_[above];
    top.child[top.child[1] == target] = parent;
    nodes_[parent].parent = above;
    nodes_[parent].child[0] = target;
    nodes_[parent].child[1] = node;
    nodes_[target].parent = parent;
    return refit(parent);
}

/// False where the moves before have put the target below the node or at its side, or where paths would get too long.
bool Reinserter::mayAttach(uint32_t node, uint32_t target) const {
    if (target == nodes_[node].parent || nodes_[node].parent == kRoot) return false;
    uint32_t depth = 0;
    for (uint32_t at = target; at != kRoot; at = nodes_[at].parent, ++depth)
        if (at == node) return false;
    return depth + 1 + std::max(nodes_[node].height, nodes_[target].height) <= kMaxDepth;
}

/// Returns by how much the areas grow: never.
double Reinserter::apply(const Move& move) {
    if (!mayAttach(move.node, move.target)) return 0;
    const uint32_t before = sibling(move.node);
    double growth = detach(move.node);
    growth += attach(move.node, move.target);
    if (growth < 0) return growth;
    detach(move.node);
    attach(move.node, before);
    return 0;
}

void Reinserter::improve() {
    double area = 0;
    for (const Node& node : nodes_) area += static_cast<double>(node.area);
    double won = 0;
    for (uint32_t round = 0; round < kMostRounds; ++round) {
        for (const Move& move : findMoves(round)) won -= apply(move);
        if (round % kStride != kStride - 1) continue;
        if (!(won > kLeastImprovement * area)) break;
        area -= won, won = 0;
    }
}

/// Which subtrees become leaves: where testing all their primitives is no dearer. Children come before parents.
void Reinserter::measureLeaves() {
    std::vector<uint32_t> order = {kRoot};
    for (size_t i = 0; i < order.size(); ++i)
        if (const Node& node = nodes_[order[i]]; !node.isLeaf()) order.insert(order.end(), {node.child[0], node.child[1]});
    std::vector<double> cost(nodes_.size());
    size_.resize(nodes_.size());
    isJoined_.resize(nodes_.size());
    std::for_each(order.rbegin(), order.rend(), [&](uint32_t i) {
        const Node& node = nodes_[i];
        const auto area = static_cast<double>(node.area);
        size_[i] = node.isLeaf() ? node.child[1] : size_[node.child[0]] + size_[node.child[1]];
        const double asLeaf = area * size_[i];
        cost[i] = node.isLeaf() ? asLeaf : area + cost[node.child[0]] + cost[node.child[1]];
        isJoined_[i] = node.isLeaf() || (size_[i] <= kMaxLeafSize && !(cost[i] < asLeaf));
        if (isJoined_[i]) cost[i] = asLeaf;
    });
}

/// Into the leaf from `leafStart` on; the pieces of a primitive become one.
void Reinserter::emitPrimitives(uint32_t node, uint32_t leafStart) {
    const Node& n = nodes_[node];
    if (n.isLeaf()) {
        const auto first = bvh_.order.begin() + n.child[0];
        for (auto at = first; at != first + n.child[1]; ++at)
            if (std::find(out_.order.begin() + leafStart, out_.order.end(), *at) == out_.order.end()) out_.order.push_back(*at);
    } else {
        for (uint32_t child : n.child) emitPrimitives(child, leafStart);
    }
}

BvhChild Reinserter::emit(uint32_t node) {
    const Box& b = nodes_[node].box;
    BvhChild reference = {{{b.lo[0], b.lo[1], b.lo[2]}, {b.hi[0], b.hi[1], b.hi[2]}}, 0, 0};
    if (isJoined_[node]) {
        reference.index = static_cast<uint32_t>(out_.order.size());
        emitPrimitives(node, reference.index);
        reference.count = static_cast<uint32_t>(out_.order.size()) - reference.index;
        ++out_.leaves;
        return reference;
    }
    reference.index = static_cast<uint32_t>(out_.nodes.size());
    out_.nodes.emplace_back();
    for (int i = 0; i < 2; ++i) {
        const BvhChild child = emit(nodes_[node].child[i]);
        out_.nodes[reference.index].child[i] = child;
    }
    return reference;
}

Bvh Reinserter::result() {
    measureLeaves();
    isJoined_[kRoot] = 0;
    out_.nodes.reserve(bvh_.nodes.size());
    out_.order.reserve(bvh_.order.size());
    emit(kRoot);
    return std::move(out_);
}

}  // namespace

Bvh reinsertSubtrees(const Bvh& bvh, ThreadPool& pool) {
    Reinserter reinserter(bvh, pool);
    reinserter.improve();
    return reinserter.result();
}

}  // namespace minirtc
