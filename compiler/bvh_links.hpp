// A hierarchy whose nodes know their parents, so that its subtrees can be moved.
#pragma once
#include "bvh_split.hpp"

namespace minirtc {

constexpr uint32_t kNoNode = 0xffffffffu;
constexpr uint32_t kRoot = 0;

/// A leaf where `height` is 0: then the children are its first slot in the order and its size. `parent` is kNoNode for the root and for what has
/// been removed.
struct LinkedNode {
    Box box;
    float area;  // half of the surface
    uint32_t parent;
    uint32_t child[2];
    uint32_t height;
    bool isLeaf() const { return height == 0; }
};

/// Functions that change the tree return by how much the sum of all areas grows.
class LinkedTree {
public:
    /// `bvh` has at least one node with two children; best given with one primitive a leaf.
    explicit LinkedTree(Bvh bvh);

    uint32_t size() const { return static_cast<uint32_t>(nodes_.size()); }
    const LinkedNode& operator[](uint32_t node) const { return nodes_[node]; }
    uint32_t sibling(uint32_t node) const;
    /// Of a leaf of one primitive.
    uint32_t primitive(uint32_t leaf) const { return bvh_.order[nodes_[leaf].child[0]]; }

    /// Takes a node, whose parent is not the root, with its parent out of the tree; they stay together, and the node's own area counts on.
    double detach(uint32_t node);
    /// The reverse: the parent goes between `target` and what is above that.
    double attach(uint32_t node, uint32_t target);
    /// Gives up a leaf that has been detached.
    double remove(uint32_t leaf);
    double setBox(uint32_t leaf, const Box& box);

    /// Whether something beside or above the node has changed since the last call for it; at first it has.
    bool takeStirred(uint32_t node);
    void stir(uint32_t node) { isStirred_[node] = 1; }

    /// Of the tree that toBvh returns, by bytesOf; more where a leaf would hold two pieces of a primitive.
    double bytes() const;
    /// Subtrees become leaves where testing all their primitives is no dearer; the pieces of a primitive in a leaf become one.
    Bvh toBvh() const;

private:
    uint32_t add(const BvhChild& child, uint32_t parent);
    double refit(uint32_t node);

    Bvh bvh_;
    std::vector<LinkedNode> nodes_;
    std::vector<uint8_t> isStirred_;
};

}  // namespace minirtc
