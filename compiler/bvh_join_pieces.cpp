#include "bvh_join_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace minirtc {
namespace {

/// A leaf that is given up to another one of the same primitive.
struct Joining {
    double growth;  // of all areas
    uint32_t piece, other;
    bool operator<(const Joining& b) const {
        return growth != b.growth ? growth > b.growth : piece > b.piece;
    }  // the best comes first
};

class Joiner {
public:
    explicit Joiner(LinkedTree& tree);
    /// The cheapest, at most `most` of them and only as long as each adds no more than `mostGrowth`. Returns how many.
    size_t join(size_t most, double mostGrowth);

private:
    std::optional<Joining> cheapest();
    std::optional<Joining> joiningOf(uint32_t piece);
    double apply(const Joining& joining);

    LinkedTree& tree_;
    std::unordered_map<uint32_t, std::vector<uint32_t>> leavesOf_;  // of primitives with several, one primitive a leaf
    std::vector<Joining> heap_;                                     // what joining took when it was looked at
};

Joiner::Joiner(LinkedTree& tree) : tree_(tree) {
    std::vector<uint32_t> leaves, count;  // of each primitive
    for (uint32_t i = 0; i < tree.size(); ++i) {
        if (!tree[i].isLeaf() || tree[i].child[1] != 1 || tree[i].parent == kNoNode) continue;
        leaves.push_back(i);
        count.resize(std::max<size_t>(count.size(), tree.primitive(i) + 1));
        ++count[tree.primitive(i)];
    }
    const auto isWhole = [&](uint32_t leaf) { return count[tree.primitive(leaf)] == 1; };
    leaves.erase(std::remove_if(leaves.begin(), leaves.end(), isWhole), leaves.end());
    for (const uint32_t leaf : leaves) leavesOf_[tree.primitive(leaf)].push_back(leaf);
    for (const uint32_t leaf : leaves)
        if (const std::optional<Joining> joining = joiningOf(leaf)) heap_.push_back(*joining);
    std::make_heap(heap_.begin(), heap_.end());
}

/// With the leaf whose box grows least; none where the leaf is the last one, or cannot be taken out.
std::optional<Joining> Joiner::joiningOf(uint32_t piece) {
    if (tree_[piece].parent == kRoot) return {};
    Joining best{0, piece, kNoNode};
    float least = kInfinity;
    for (const uint32_t other : leavesOf_.at(tree_.primitive(piece))) {
        const float growth = joined(tree_[other].box, tree_[piece].box).halfArea() - tree_[other].area;
        if (other != piece && growth < least) least = growth, best.other = other;
    }
    if (best.other == kNoNode) return {};
    const Box box = tree_[best.other].box;
    const uint32_t sibling = tree_.sibling(piece);
    best.growth = apply(best) - static_cast<double>(tree_[piece].area);
    tree_.setBox(best.other, box);
    tree_.attach(piece, sibling);
    return best;
}

double Joiner::apply(const Joining& joining) {
    const double growth = tree_.detach(joining.piece);
    return growth + tree_.setBox(joining.other, joined(tree_[joining.other].box, tree_[joining.piece].box));
}

/// What is on top of the heap is looked at again, as what was joined before may have changed it.
std::optional<Joining> Joiner::cheapest() {
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end());
        const std::optional<Joining> joining = joiningOf(heap_.back().piece);
        heap_.pop_back();
        if (!joining) continue;
        if (heap_.empty() || !(*joining < heap_.front())) return joining;
        heap_.push_back(*joining);
        std::push_heap(heap_.begin(), heap_.end());
    }
    return {};
}

size_t Joiner::join(size_t most, double mostGrowth) {
    for (size_t count = 0; count < most; ++count) {
        const std::optional<Joining> joining = cheapest();
        if (!joining) return count;
        if (joining->growth > mostGrowth) {
            heap_.push_back(*joining);
            std::push_heap(heap_.begin(), heap_.end());
            return count;
        }
        apply(*joining);
        tree_.remove(joining->piece);
        std::vector<uint32_t>& leaves = leavesOf_.at(tree_.primitive(joining->piece));
        leaves.erase(std::find(leaves.begin(), leaves.end(), joining->piece));
    }
    return most;
}

}  // namespace

void joinPieces(LinkedTree& tree, double mostBytes) {
    constexpr double kBytesOfPiece = 65;  // about: of its leaf and of half a node
    Joiner joiner(tree);
    joiner.join(tree.size(), 0);
    for (double excess = tree.bytes() - mostBytes; excess > 0; excess = tree.bytes() - mostBytes)
        if (joiner.join(static_cast<size_t>(std::ceil(excess / kBytesOfPiece)), kInfinity) == 0) return;
}

}  // namespace minirtc
