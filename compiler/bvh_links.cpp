#include "bvh_links.hpp"

#include <algorithm>

namespace minirtc {
namespace {

/// What becomes of each subtree.
struct Leaves {
    std::vector<uint8_t> isLeaf;
    std::vector<uint32_t> primitives, nodes;  // in the subtree; of nodes those that are left

    explicit Leaves(const LinkedTree& tree);
};

/// Children come before parents.
Leaves::Leaves(const LinkedTree& tree) : isLeaf(tree.size()), primitives(tree.size()), nodes(tree.size()) {
    std::vector<uint32_t> order = {kRoot};
    for (size_t i = 0; i < order.size(); ++i)
        if (const LinkedNode& node = tree[order[i]]; !node.isLeaf()) order.insert(order.end(), {node.child[0], node.child[1]});
    std::vector<double> cost(tree.size());
    std::for_each(order.rbegin(), order.rend(), [&](uint32_t i) {
        const LinkedNode& node = tree[i];
        const auto area = static_cast<double>(node.area);
        const uint32_t *child = node.child, size = node.isLeaf() ? child[1] : primitives[child[0]] + primitives[child[1]];
        const double asLeaf = area * size;
        cost[i] = node.isLeaf() ? asLeaf : area + cost[child[0]] + cost[child[1]];
        isLeaf[i] = node.isLeaf() || (i != kRoot && size <= kMaxLeafSize && !(cost[i] < asLeaf));
        if (isLeaf[i]) cost[i] = asLeaf;
        primitives[i] = size;
        nodes[i] = isLeaf[i] ? 0 : 1 + nodes[child[0]] + nodes[child[1]];
    });
}

/// Writes a tree, depth first.
class Emitter {
public:
    Emitter(const LinkedTree& tree, const std::vector<uint32_t>& order) : tree_(tree), order_(order), leaves_(tree) {
        bvh_.nodes.reserve(leaves_.nodes[kRoot]);
        bvh_.order.reserve(leaves_.primitives[kRoot]);
    }
    Bvh emit() {
        emit(kRoot);
        return std::move(bvh_);
    }

private:
    BvhChild emit(uint32_t node);
    void emitPrimitives(uint32_t node, uint32_t leafStart);

    const LinkedTree& tree_;
    const std::vector<uint32_t>& order_;
    const Leaves leaves_;
    Bvh bvh_;
};

/// Into the leaf from `leafStart` on.
void Emitter::emitPrimitives(uint32_t node, uint32_t leafStart) {
    const LinkedNode& n = tree_[node];
    if (n.isLeaf()) {
        const auto first = order_.begin() + n.child[0];
        for (auto at = first; at != first + n.child[1]; ++at)
            if (std::find(bvh_.order.begin() + leafStart, bvh_.order.end(), *at) == bvh_.order.end()) bvh_.order.push_back(*at);
    } else {
        for (uint32_t child : n.child) emitPrimitives(child, leafStart);
    }
}

BvhChild Emitter::emit(uint32_t node) {
    const Box& b = tree_[node].box;
    BvhChild reference = {{{b.lo[0], b.lo[1], b.lo[2]}, {b.hi[0], b.hi[1], b.hi[2]}}, 0, 0};
    if (leaves_.isLeaf[node]) {
        reference.index = static_cast<uint32_t>(bvh_.order.size());
        emitPrimitives(node, reference.index);
        reference.count = static_cast<uint32_t>(bvh_.order.size()) - reference.index;
        ++bvh_.leaves;
        return reference;
    }
    reference.index = static_cast<uint32_t>(bvh_.nodes.size());
    bvh_.nodes.emplace_back();
    for (int i = 0; i < 2; ++i) {
        const BvhChild child = emit(tree_[node].child[i]);
        bvh_.nodes[reference.index].child[i] = child;
    }
    return reference;
}

bool areEqual(const Box& a, const Box& b) {
    const Int4 differ = (a.lo != b.lo) | (a.hi != b.hi);
    return (differ[0] | differ[1] | differ[2]) == 0;
}

}  // namespace

LinkedTree::LinkedTree(Bvh bvh) : bvh_(std::move(bvh)) {
    nodes_.reserve(2 * bvh_.nodes.size() + 1);
    BvhChild root;
    root.box = bvh_.nodes[0].child[0].box;
    root.box.grow(bvh_.nodes[0].child[1].box);
    add(root, kNoNode);
    isStirred_.assign(nodes_.size(), 1);
    bvh_.nodes = {};  // only the order is read again
}

/// The subtree of `child`, whose depth is bounded.
uint32_t LinkedTree::add(const BvhChild& child, uint32_t parent) {
    const uint32_t place = size();
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

uint32_t LinkedTree::sibling(uint32_t node) const {
    const LinkedNode& parent = nodes_[nodes_[node].parent];
    return parent.child[parent.child[0] == node];
}

/// Boxes and heights from `first` up, to where nothing changes any more.
double LinkedTree::refit(uint32_t first) {
    double growth = 0;
    for (uint32_t node = first; node != kNoNode; node = nodes_[node].parent) {
        LinkedNode& n = nodes_[node];
        const LinkedNode &a = nodes_[n.child[0]], &b = nodes_[n.child[1]];
        Box box = a.box;
        box.grow(b.box);
        const uint32_t height = std::max(a.height, b.height) + 1;
        if (node != first && height == n.height && areEqual(box, n.box)) break;
        const float area = box.halfArea();
        growth += static_cast<double>(area) - static_cast<double>(n.area);
        n.box = box, n.area = area, n.height = height;
        stir(n.child[0]), stir(n.child[1]);
    }
    return growth;
}

double LinkedTree::detach(uint32_t node) {
    const uint32_t parent = nodes_[node].parent, other = sibling(node), above = nodes_[parent].parent;
    LinkedNode& top = nodes_[above];
    top.child[top.child[1] == parent] = other;
    nodes_[other].parent = above;
    const double area = static_cast<double>(nodes_[parent].area);
    nodes_[parent].area = 0;
    return refit(above) - area;
}

double LinkedTree::attach(uint32_t node, uint32_t target) {
    const uint32_t parent = nodes_[node].parent, above = nodes_[target].parent;
    LinkedNode& top = nodes_[above];
    top.child[top.child[1] == target] = parent;
    nodes_[parent].parent = above;
    nodes_[parent].child[0] = target;
    nodes_[parent].child[1] = node;
    nodes_[target].parent = parent;
    return refit(parent);
}

double LinkedTree::remove(uint32_t leaf) {
    LinkedNode& node = nodes_[leaf];
    const double area = static_cast<double>(node.area);
    nodes_[node.parent].parent = kNoNode;
    node.parent = kNoNode;
    node.area = 0;
    return -area;
}

double LinkedTree::setBox(uint32_t leaf, const Box& box) {
    LinkedNode& node = nodes_[leaf];
    const double area = static_cast<double>(node.area);
    node.box = box;
    node.area = box.halfArea();
    return static_cast<double>(node.area) - area + refit(node.parent);
}

bool LinkedTree::takeStirred(uint32_t node) {
    const bool stirred = isStirred_[node] != 0;
    isStirred_[node] = 0;
    return stirred;
}

double LinkedTree::bytes() const {
    const Leaves leaves(*this);
    return bytesOf(leaves.primitives[kRoot], leaves.nodes[kRoot]);
}

Bvh LinkedTree::toBvh() const {
    return Emitter(*this, bvh_.order).emit();
}

}  // namespace minirtc
