#include "bvh_reinsert.hpp"

#include <algorithm>

namespace minirtc {
namespace {

constexpr uint32_t kParts = 2;  // of a sweep over all nodes: the moves of one are made before those of the next are sought
constexpr uint32_t kMostSweeps = 8;
constexpr double kLeastImprovement = 8e-4;  // of the cost by a sweep, or it is not worth another
constexpr uint32_t kMostPlaces = 100;  // that a search looks at: enough for surfaces; where everything overlaps it would be all
constexpr uint32_t kChunkSize = 256;   // nodes that a thread takes at once

struct Move {
    float gain = 0;  // of area
    uint32_t node = kNoNode;
    uint32_t target = kNoNode;  // becomes the sibling
    bool operator<(const Move& other) const { return gain != other.gain ? gain > other.gain : node < other.node; }
};

/// `gain`: what leaving gains. Boxes around a place grow, and its new parent costs at least the area of the node: where that is too much
/// already, nothing below is better.
void searchSubtree(const LinkedTree& tree, uint32_t start, float gain, Move& best, uint32_t& placesLeft) {
    struct Place {
        uint32_t node;
        float gain;
    };
    const Box& box = tree[best.node].box;
    const float area = tree[best.node].area;
    Place stack[kMaxDepth + 2];
    int level = 0;
    stack[level++] = {start, gain};
    while (level > 0 && placesLeft > 0) {
        const Place place = stack[--level];
        if (!(place.gain - area > best.gain)) continue;
        --placesLeft;
        const LinkedNode& node = tree[place.node];
        const float around = joined(node.box, box).halfArea();
        if (place.gain - around > best.gain) best.gain = place.gain - around, best.target = place.node;
        const float below = place.gain - (around - node.area);
        if (node.isLeaf() || !(below - area > best.gain)) continue;
        stack[level++] = {node.child[1], below};
        stack[level++] = {node.child[0], below};
    }
}

/// Without the node its parent goes and all boxes on the way up shrink: what the places under each of these can gain grows on the way.
Move bestMove(const LinkedTree& tree, uint32_t node) {
    Move best;
    best.node = node;
    uint32_t pivot = tree[node].parent;
    if (pivot == kNoNode || pivot == kRoot) return best;
    float gain = tree[pivot].area;
    Box rest = tree[tree.sibling(node)].box;
    uint32_t placesLeft = kMostPlaces;
    searchSubtree(tree, tree.sibling(node), gain, best, placesLeft);
    while (pivot != kRoot && placesLeft > 0) {
        const uint32_t aside = tree.sibling(pivot);
        searchSubtree(tree, aside, gain, best, placesLeft);
        rest.grow(tree[aside].box);
        pivot = tree[pivot].parent;
        gain += tree[pivot].area - rest.halfArea();
    }
    return best;
}

/// Of this part's nodes, without those near which nothing has changed since they were tried.
std::vector<Move> findMoves(LinkedTree& tree, uint32_t part, ThreadPool& pool) {
    const uint32_t count = (tree.size() + kParts - 1 - part) / kParts;
    std::vector<Move> moves(count);
    pool.parallelFor((count + kChunkSize - 1) / kChunkSize, [&](size_t chunk) {
        const auto begin = static_cast<uint32_t>(chunk) * kChunkSize;
        for (uint32_t i = begin; i < std::min(count, begin + kChunkSize); ++i)
            if (const uint32_t node = i * kParts + part; tree.takeStirred(node)) moves[i] = bestMove(tree, node);
    });
    moves.erase(std::remove_if(moves.begin(), moves.end(), [](const Move& m) { return m.target == kNoNode; }), moves.end());
    std::sort(moves.begin(), moves.end());
    return moves;
}

/// False where the moves before have put the target below the node or at its side, or where paths would get too long.
bool mayAttach(const LinkedTree& tree, uint32_t node, uint32_t target) {
    if (target == tree[node].parent || tree[node].parent == kRoot) return false;
    uint32_t depth = 0;
    for (uint32_t at = target; at != kRoot; at = tree[at].parent, ++depth)
        if (at == node) return false;
    return depth + 1 + std::max(tree[node].height, tree[target].height) <= kMaxDepth;
}

/// Returns by how much the areas grow: never.
double apply(LinkedTree& tree, const Move& move) {
    tree.stir(move.node);
    if (!mayAttach(tree, move.node, move.target)) return 0;
    const uint32_t before = tree.sibling(move.node);
    double growth = tree.detach(move.node);
    growth += tree.attach(move.node, move.target);
    if (growth < 0) return growth;
    tree.detach(move.node);
    tree.attach(move.node, before);
    return 0;
}

}  // namespace

void reinsertSubtrees(LinkedTree& tree, ThreadPool& pool) {
    double area = 0;
    for (uint32_t node = 0; node < tree.size(); ++node) area += static_cast<double>(tree[node].area);
    bool triesAll = true;
    for (uint32_t sweep = 0; sweep < kMostSweeps; ++sweep) {
        double won = 0;
        for (uint32_t part = 0; part < kParts; ++part)
            for (const Move& move : findMoves(tree, part, pool)) won -= apply(tree, move);
        area -= won;
        const bool pays = won > kLeastImprovement * area;
        if (triesAll && !pays) return;
        triesAll = !pays;
        for (uint32_t node = 0; triesAll && node < tree.size(); ++node) tree.stir(node);
    }
}

}  // namespace minirtc
