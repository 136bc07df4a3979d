#include "embree_tree.hpp"

#include "timing.hpp"

#if MINIRT_HAVE_EMBREE
#include <embree3/rtcore.h>

#include <algorithm>
#include <new>
#endif

namespace bench {

#if MINIRT_HAVE_EMBREE

namespace {

/// A node as Embree makes it: inner where `count` is 0.
struct Node {
    RTCBounds box[2];
    Node* child[2];
    uint32_t count;
    uint32_t primitives[minirtc::kMaxLeafSize];
};

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node{};
}

void setChildren(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->child[i] = static_cast<Node*>(children[i]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->box[i] = *bounds[i];
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void*) {
    Node* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node{};
    leaf->count = static_cast<uint32_t>(std::min<size_t>(count, minirtc::kMaxLeafSize));
    for (uint32_t i = 0; i < leaf->count; ++i) leaf->primitives[i] = primitives[i].primID;
    return leaf;
}

RTCBounds toBounds(const minirtc::Aabb& box) {
    return {box.lo.x, box.lo.y, box.lo.z, 0, box.hi.x, box.hi.y, box.hi.z, 0};
}

minirtc::Aabb toBox(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

minirtc::Aabb intersection(const minirtc::Aabb& a, const minirtc::Aabb& b) {
    return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

/// The boxes of what lies on either side of a plane, of the part of the triangle in the primitive's box.
void splitPrimitive(const RTCBuildPrimitive* primitive, unsigned axisNumber, float position, RTCBounds* left, RTCBounds* right,
                    void* mesh) {
    const Triangle& triangle = (*static_cast<const Triangles*>(mesh))[primitive->primID];
    const int axis = static_cast<int>(axisNumber);
    minirtc::Aabb sides[2];
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
        if (a[axis] <= position) sides[0].grow(a);
        if (a[axis] >= position) sides[1].grow(a);
        if ((a[axis] < position) == (b[axis] < position) || a[axis] == b[axis]) continue;
        glm::vec3 p = a + (b - a) * ((position - a[axis]) / (b[axis] - a[axis]));
        p[axis] = position;
        sides[0].grow(p), sides[1].grow(p);
    }
    const minirtc::Aabb box = {{primitive->lower_x, primitive->lower_y, primitive->lower_z},
                               {primitive->upper_x, primitive->upper_y, primitive->upper_z}};
    *left = toBounds(intersection(sides[0], box));
    *right = toBounds(intersection(sides[1], box));
}

minirtc::BvhChild convert(const Node& node, const RTCBounds& box, minirtc::Bvh& bvh);

uint32_t convertInner(const Node& node, minirtc::Bvh& bvh) {
    const auto place = static_cast<uint32_t>(bvh.nodes.size());
    bvh.nodes.emplace_back();
    for (int i = 0; i < 2; ++i) {
        const minirtc::BvhChild child = convert(*node.child[i], node.box[i], bvh);
        bvh.nodes[place].child[i] = child;
    }
    return place;
}

minirtc::BvhChild convert(const Node& node, const RTCBounds& box, minirtc::Bvh& bvh) {
    if (node.count == 0) return {toBox(box), convertInner(node, bvh), 0};
    const auto first = static_cast<uint32_t>(bvh.order.size());
    bvh.order.insert(bvh.order.end(), node.primitives, node.primitives + node.count);
    ++bvh.leaves;
    return {toBox(box), first, node.count};
}

std::vector<RTCBuildPrimitive> primitivesOf(const Triangles& mesh, size_t room) {
    std::vector<RTCBuildPrimitive> primitives(room);
    for (size_t i = 0; i < mesh.size(); ++i) {
        minirtc::Aabb box;
        for (const glm::vec3& p : mesh[i]) box.grow(p);
        primitives[i] = {box.lo.x, box.lo.y, box.lo.z, 0, box.hi.x, box.hi.y, box.hi.z, static_cast<unsigned>(i)};
    }
    return primitives;
}

RTCBuildQuality embreeQuality(EmbreeQuality quality) {
    switch (quality) {
        case EmbreeQuality::low:
            return RTC_BUILD_QUALITY_LOW;
        case EmbreeQuality::medium:
            return RTC_BUILD_QUALITY_MEDIUM;
        case EmbreeQuality::high:
            break;
    }
    return RTC_BUILD_QUALITY_HIGH;
}

RTCBuildArguments argumentsFor(EmbreeQuality quality) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = embreeQuality(quality);
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = minirtc::kMaxDepth;
    arguments.maxLeafSize = minirtc::kMaxLeafSize;
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    arguments.splitPrimitive = splitPrimitive;
    return arguments;
}

}  // namespace

minirtc::Bvh embreeTree(const Triangles& mesh, EmbreeQuality quality) {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCBuildArguments arguments = argumentsFor(quality);
    arguments.bvh = rtcNewBVH(device);
    const double start = nowMs();
    std::vector<RTCBuildPrimitive> primitives = primitivesOf(mesh, mesh.size() * (quality == EmbreeQuality::high ? 2 : 1));
    arguments.primitives = primitives.data();
    arguments.primitiveCount = mesh.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.userPtr = const_cast<Triangles*>(&mesh);  // only read
    const auto* root = static_cast<const Node*>(rtcBuildBVH(&arguments));
    minirtc::Bvh bvh;
    bvh.buildMs = nowMs() - start;
    if (root->count == 0) convertInner(*root, bvh);
    bvh.sahCost = minirtc::sahCost(bvh);
    rtcReleaseBVH(arguments.bvh);
    rtcReleaseDevice(device);
    return bvh;
}

#else

minirtc::Bvh embreeTree(const Triangles&, EmbreeQuality) {
    return {};
}

#endif

}  // namespace bench
