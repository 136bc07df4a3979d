#include "volumes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "closed_surface.hpp"
#include "volume_overlap.hpp"

namespace minirtc {
namespace {

struct Volume {
    uint32_t body;  // index into Geometry::bodies
    Solid solid;
    double size;  // in m^3

    const Surface& surface() const { return solid.surface; }
};

std::string toText(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// "12.1 cm^3"
std::string readableVolume(double cubicMetres) {
    if (cubicMetres >= 1000) return toText("%.0f m^3", cubicMetres);
    if (cubicMetres >= 1) return toText("%.3g m^3", cubicMetres);
    if (cubicMetres >= 1e-3) return toText("%.3g l", cubicMetres * 1e3);
    if (cubicMetres >= 1e-6) return toText("%.3g cm^3", cubicMetres * 1e6);
    return toText("%.3g mm^3", cubicMetres * 1e9);
}

std::vector<std::vector<Primitive>> volumePrimitives(const Geometry& geometry, const std::vector<Primitive>& all) {
    std::vector<std::vector<Primitive>> primitives(geometry.bodies.size());
    for (const Primitive& primitive : all)
        if (geometry.bodies[primitive.body].isVolume()) primitives[primitive.body].push_back(primitive);
    return primitives;
}

Volume sphereVolume(uint32_t body, const Primitive& sphere) {
    const double radius = sphere.p[1].x;
    constexpr double kPi = 3.14159265358979323846;
    return {body, {Surface({sphere}), {}}, 4.0 / 3.0 * kPi * radius * radius * radius};
}

/// Throws Error where it is none.
Volume meshVolume(const Geometry& geometry, uint32_t body, const std::vector<Primitive>& triangles,
                  const std::vector<Primitive>& slivers) {
    const ClosedSurface closed = requireClosed(triangles, slivers, geometry.bodies[body], geometry.origin);
    Volume volume = {body, {Surface(triangles), {}}, closed.size};
    for (const uint32_t shell : closed.shells) volume.solid.shells.push_back(triangleOf(triangles[shell]));
    return volume;
}

std::vector<Volume> volumesOf(const Geometry& geometry) {
    const std::vector<std::vector<Primitive>> primitives = volumePrimitives(geometry, geometry.primitives),
                                              slivers = volumePrimitives(geometry, geometry.slivers);
    std::vector<Volume> volumes;
    for (uint32_t body = 0; body < geometry.bodies.size(); ++body) {
        if (!geometry.bodies[body].isVolume() || primitives[body].empty()) continue;
        const bool isSphere = primitives[body][0].isSphere;
        volumes.push_back(isSphere ? sphereVolume(body, primitives[body][0])
                                   : meshVolume(geometry, body, primitives[body], slivers[body]));
    }
    return volumes;
}

/// Over the offset of a ray that leaves a surface (trianglePoint in shaders/traverse/triangle.glsl).
double offsetBound(const Aabb& a, const Aabb& b) {
    float largest = 0;
    for (const glm::vec3& corner : {a.lo, a.hi, b.lo, b.hi})
        for (int i = 0; i < 3; ++i) largest = std::max(largest, std::fabs(corner[i]));
    constexpr double kGamma7 = 7 * 0x1p-24 / (1 - 7 * 0x1p-24);
    return kGamma7 * largest;
}

/// The least number k such that every set of volumes has one that overlaps at most k others of the set: no k + 2 volumes all overlap one another.
uint32_t degeneracy(const std::vector<std::vector<uint32_t>>& neighbours) {
    std::vector<uint32_t> degree;
    degree.reserve(neighbours.size());
    for (const std::vector<uint32_t>& list : neighbours) degree.push_back(static_cast<uint32_t>(list.size()));
    uint32_t result = 0;
    for (size_t removed = 0; removed < neighbours.size(); ++removed) {
        const auto least = std::min_element(degree.begin(), degree.end());  // kNone: removed
        result = std::max(result, *least);
        *least = kNone;
        for (const uint32_t other : neighbours[static_cast<size_t>(least - degree.begin())])
            if (degree[other] != kNone) --degree[other];
    }
    return result;
}

constexpr size_t kShownPairs = 8;  // warnings of a kind

class Analysis {
public:
    Analysis(const Scene& scene, const Geometry& geometry, Diagnostics& diagnostics)
        : scene_(scene), geometry_(geometry), diagnostics_(diagnostics), volumes_(volumesOf(geometry)) {}

    Volumes run() {
        makeOrder();
        result_.count = static_cast<uint32_t>(volumes_.size());
        overlaps_.resize(volumes_.size());
        for (uint32_t i = 0; i < volumes_.size(); ++i)
            for (uint32_t k = i + 1; k < volumes_.size(); ++k) comparePair(i, k);
        warnOfMore();
        findSelfOverlap();
        findContent();
        makeCapacity();
        return std::move(result_);
    }

private:
    const Body& bodyOf(const Volume& volume) const { return geometry_.bodies[volume.body]; }

    /// True where `b` displaces `a`.
    bool isBelow(uint32_t a, uint32_t b) const {
        const int priorityA = bodyOf(volumes_[a]).priority, priorityB = bodyOf(volumes_[b]).priority;
        if (priorityA != priorityB) return priorityA < priorityB;
        if (volumes_[a].size != volumes_[b].size) return volumes_[a].size > volumes_[b].size;
        return a < b;
    }

    void makeOrder() {
        std::vector<uint32_t> order(volumes_.size());
        for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return isBelow(a, b); });
        for (const uint32_t i : order) result_.order.push_back(volumes_[i].body);
        std::vector<bool> isListed(geometry_.bodies.size());
        for (const uint32_t body : result_.order) isListed[body] = true;
        for (uint32_t body = 0; body < geometry_.bodies.size(); ++body)
            if (!isListed[body]) result_.order.push_back(body);
    }

    void comparePair(uint32_t i, uint32_t k) {
        const Volume &a = volumes_[i], &b = volumes_[k];
        const double distance = 2 * offsetBound(a.surface().box(), b.surface().box());
        if (!areNear(a.surface().box(), b.surface().box(), distance)) return;
        if (lieOnEachOther(a.surface(), b.surface(), distance)) warnOfContact(a, b, distance);
        const Overlap overlap = overlapOf(a.solid, b.solid);
        if (overlap == Overlap::none) return;
        overlaps_[i].push_back(k);
        overlaps_[k].push_back(i);
        if (result_.overlap.empty()) result_.overlap = describe(a, b, overlap);
        const bool below = isBelow(i, k);
        displace(below ? b : a, below ? a : b, overlap == (below ? Overlap::secondInside : Overlap::firstInside));
        if (overlap == Overlap::partial) warnOfGuess(a, b);
    }

    std::string describe(const Volume& a, const Volume& b, Overlap overlap) const {
        const std::string &nameA = bodyOf(a).name, &nameB = bodyOf(b).name;
        if (overlap == Overlap::firstInside) return nameA + " in " + nameB;
        if (overlap == Overlap::secondInside) return nameB + " in " + nameA;
        return nameA + " overlaps " + nameB;
    }

    void displace(const Volume& above, const Volume& below, bool liesInside) {
        const int high = bodyOf(above).priority, low = bodyOf(below).priority;
        std::string reason = "it is smaller (" + readableVolume(above.size) + " against " + readableVolume(below.size) + ")";
        if (liesInside)
            reason = "it lies inside";
        else if (above.size == below.size)
            reason = "it comes later in the scene (both have " + readableVolume(above.size) + ")";
        if (high != low) reason = "its priority is higher (" + std::to_string(high) + " over " + std::to_string(low) + ")";
        result_.displacements.push_back({above.body, below.body, reason});
    }

    void warnOfContact(const Volume& a, const Volume& b, double distance) {
        if (contacts_++ >= kShownPairs) return;
        diagnostics_.warn(bodyOf(b).location,
                          "faces of " + bodyOf(a).name + " and " + bodyOf(b).name +
                              " lie on each other, or nearer than rounding can tell: a ray may pass over one of them",
                          "let the two overlap by more than " + toText("%.2g m", 1.05 * distance));
    }

    /// Where neither priorities nor one inside the other decide, and the sizes hardly do.
    void warnOfGuess(const Volume& a, const Volume& b) {
        constexpr double kClear = 0.8;
        if (bodyOf(a).priority != bodyOf(b).priority) return;
        if (std::min(a.size, b.size) <= kClear * std::max(a.size, b.size)) return;
        if (guesses_++ >= kShownPairs) return;
        const Displacement& guess = result_.displacements.back();
        diagnostics_.warn(bodyOf(b).location,
                          bodyOf(a).name + " and " + bodyOf(b).name + " overlap and are of like size: it is a guess that " +
                              geometry_.bodies[guess.above].name + " displaces " + geometry_.bodies[guess.below].name,
                          "give one of them a higher \"priority\"");
    }

    void warnOfMore() {
        const auto more = [&](size_t count, const std::string& what, const std::string& hint) {
            if (count > kShownPairs)
                diagnostics_.warn({scene_.path}, std::to_string(count - kShownPairs) + " more pairs of volumes " + what, hint);
        };
        more(contacts_, "have faces that lie on each other, or nearer than rounding can tell", "let them overlap");
        more(guesses_, "overlap and are of like size", "--explain lists them");
    }

    void findSelfOverlap() {
        for (const Volume& volume : volumes_) {
            const Body& body = bodyOf(volume);
            if (isInsideOutInPart(volume.solid))
                diagnostics_.warn(body.location, body.name + " is inside out in part: a piece of it has its front inside",
                                  "wind all faces counter-clockwise as seen from outside");
            if (result_.selfOverlap.empty() && overlapsItself(volume.solid)) result_.selfOverlap = body.name + " overlaps itself";
        }
    }

    void findContent() {
        if (volumes_.empty()) return;
        findLightsInside();
        std::vector<std::vector<Primitive>> near = primitivesNearVolumes();
        for (uint32_t body = 0; body < near.size() && result_.content.empty(); ++body)
            if (!near[body].empty()) findInside(body, Surface(std::move(near[body])));
    }

    void findLightsInside() {
        for (size_t i = 0; i < scene_.lights.size(); ++i) {
            const glm::dvec3 position = scene_.lights[i].position - geometry_.origin;
            if (scene_.lights[i].type == LightType::directional) continue;
            for (const Volume& volume : volumes_) {
                if (!result_.content.empty()) return;
                if (volume.surface().windingAt(position).value_or(1) > 0)
                    result_.content = result_.lightInside = "light " + std::to_string(i) + " in " + bodyOf(volume).name;
            }
        }
    }

    void findInside(uint32_t body, const Surface& thing) {
        for (const Volume& volume : volumes_) {
            if (!isContent(thing, volume.surface())) continue;
            result_.content = geometry_.bodies[body].name + " in " + bodyOf(volume).name;
            return;
        }
    }

    /// Of each body that is no volume: what is in the box of a volume.
    std::vector<std::vector<Primitive>> primitivesNearVolumes() const {
        const std::vector<Bounds> boxes = bodyBounds(geometry_);
        std::vector<std::vector<Aabb>> nearBody(geometry_.bodies.size());
        for (uint32_t body = 0; body < geometry_.bodies.size(); ++body)
            for (const Volume& volume : volumes_)
                if (!geometry_.bodies[body].isVolume() && areNear({boxes[body].min, boxes[body].max}, volume.surface().box(), 0))
                    nearBody[body].push_back(volume.surface().box());
        std::vector<std::vector<Primitive>> near(geometry_.bodies.size());
        for (const Primitive& primitive : geometry_.primitives) {
            const std::vector<Aabb>& candidates = nearBody[primitive.body];
            const auto isNear = [&](const Aabb& box) { return areNear(bounds(primitive), box, 0); };
            if (std::any_of(candidates.begin(), candidates.end(), isNear)) near[primitive.body].push_back(primitive);
        }
        return near;
    }

    void makeCapacity() {
        if (volumes_.empty()) return;
        const uint32_t bound = degeneracy(overlaps_) + 1;
        result_.capacity = std::min(bound, kMostNested);
        if (bound > kMostNested)
            diagnostics_.warn({scene_.path},
                              "up to " + std::to_string(bound) + " volumes may lie over one another, and a ray keeps track of " +
                                  std::to_string(kMostNested),
                              "the surfaces of more are passed over, and counted as volume_overflow");
    }

    const Scene& scene_;
    const Geometry& geometry_;
    Diagnostics& diagnostics_;
    std::vector<Volume> volumes_;
    std::vector<std::vector<uint32_t>> overlaps_;  // of each volume
    size_t contacts_ = 0, guesses_ = 0;            // pairs that a warning tells of
    Volumes result_;
};

}  // namespace

Volumes analyseVolumes(const Scene& scene, const Geometry& geometry, Diagnostics& diagnostics) {
    return Analysis(scene, geometry, diagnostics).run();
}

}  // namespace minirtc
