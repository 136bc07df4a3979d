#include <algorithm>
#include <cmath>
#include <cstring>

#include "blob.hpp"

namespace minirtc {
namespace {

constexpr int kGridPlanes = 65535;
constexpr double kAcceptedInflation = 1.1;

/// Numbers of the planes around an interval, rounded outwards; an empty interval stays empty.
struct PlaneRange {
    uint32_t lo = kGridPlanes;
    uint32_t hi = 0;
};

PlaneRange quantise(float lo, float hi, float origin, float scale) {
    if (lo > hi) return {};
    const auto clampPlane = [](double p) { return static_cast<uint32_t>(std::clamp(p, 0.0, static_cast<double>(kGridPlanes))); };
    return {clampPlane(std::floor((static_cast<double>(lo) - origin) / scale)),
            clampPlane(std::ceil((static_cast<double>(hi) - origin) / scale))};
}

uint32_t reference(const BvhChild& child) {
    return child.count ? MINIRT_LEAF | child.index << 3 | (child.count - 1) : child.index;
}

uint32_t bits(float value) {
    uint32_t word;
    std::memcpy(&word, &value, sizeof word);
    return word;
}

/// Expected work of a random ray, as Bvh::sahCost defines it, over the boxes that `boxOf` gives.
template <typename BoxOf>
double costOf(const Bvh& bvh, float rootArea, BoxOf boxOf) {
    double cost = rootArea;
    for (const BvhNode& node : bvh.nodes) {
        for (const BvhChild& child : node.child) {
            cost += static_cast<double>(boxOf(child).halfArea()) * (child.count ? static_cast<double>(child.count) : 1.0);
        }
    }
    return rootArea > 0 ? cost / rootArea : cost;
}

}  // namespace

EncodedNodes quantiseNodes(const Bvh& bvh, const Geometry& geometry) {
    EncodedNodes out;
    out.layout = MINIRT_NODES_QUANTISED;
    out.gridOrigin = geometry.boundsMin;
    out.gridPlanes = glm::vec3(kGridPlanes);
    const glm::vec3 extent = geometry.boundsMax - geometry.boundsMin;
    const float largest = std::max({extent.x, extent.y, extent.z, 1e-30f});
    // A flat scene still gets cells, and the far side stays inside of the last plane after rounding.
    out.gridScale = glm::max(extent, glm::vec3(largest * 1e-6f)) / static_cast<float>(kGridPlanes) * 1.000001f;
    const auto planes = [&](const Aabb& box, int axis) {
        return quantise(box.lo[axis], box.hi[axis], out.gridOrigin[axis], out.gridScale[axis]);
    };
    out.words.reserve(bvh.nodes.size() * 8);
    for (const BvhNode& node : bvh.nodes) {
        for (const BvhChild& child : node.child) {
            const PlaneRange x = planes(child.box, 0);
            const PlaneRange y = planes(child.box, 1);
            const PlaneRange z = planes(child.box, 2);
            out.words.insert(out.words.end(), {x.lo | x.hi << 16, y.lo | y.hi << 16, z.lo | z.hi << 16, reference(child)});
        }
    }
    const auto rounded = [&](const BvhChild& child) {
        Aabb box;
        for (int axis = 0; axis < 3; ++axis) {
            const PlaneRange p = planes(child.box, axis);
            box.lo[axis] = out.gridOrigin[axis] + out.gridScale[axis] * static_cast<float>(p.lo);
            box.hi[axis] = out.gridOrigin[axis] + out.gridScale[axis] * static_cast<float>(p.hi);
        }
        return box;
    };
    out.sahCost = costOf(bvh, Aabb{geometry.boundsMin, geometry.boundsMax}.halfArea(), rounded);
    return out;
}

EncodedNodes floatNodes(const Bvh& bvh, const Geometry& geometry) {
    EncodedNodes out;
    out.layout = MINIRT_NODES_FLOAT;
    out.gridPlanes = glm::max(glm::abs(geometry.boundsMin), glm::abs(geometry.boundsMax));
    // An empty box must stay finite and be missed: a point on the far side of everything, inside out.
    const Aabb empty{out.gridPlanes + glm::vec3(1), -out.gridPlanes - glm::vec3(1)};
    out.words.reserve(bvh.nodes.size() * 16);
    for (const BvhNode& node : bvh.nodes) {
        for (const BvhChild& child : node.child) {
            const Aabb& box = child.box.lo.x > child.box.hi.x ? empty : child.box;
            out.words.insert(out.words.end(), {bits(box.lo.x), bits(box.lo.y), bits(box.lo.z), reference(child)});
            out.words.insert(out.words.end(), {bits(box.hi.x), bits(box.hi.y), bits(box.hi.z), 0u});
        }
    }
    out.sahCost =
        costOf(bvh, Aabb{geometry.boundsMin, geometry.boundsMax}.halfArea(), [](const BvhChild& child) { return child.box; });
    return out;
}

EncodedNodes encodeNodes(const Bvh& bvh, const Geometry& geometry, LayoutChoice choice) {
    if (choice == LayoutChoice::floating) return floatNodes(bvh, geometry);
    EncodedNodes quantised = quantiseNodes(bvh, geometry);
    if (choice == LayoutChoice::quantised) return quantised;
    EncodedNodes exact = floatNodes(bvh, geometry);
    return quantised.sahCost <= exact.sahCost * kAcceptedInflation ? quantised : exact;
}

}  // namespace minirtc
