#include "volumes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "closed_surface.hpp"
#include "parallel.hpp"
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
    return {body, {Surface({sphere}, 1), {}}, 4.0 / 3.0 * kPi * radius * radius * radius};
}

/// Throws Error where it is none.
Volume meshVolume(const Geometry& geometry, uint32_t body, const std::vector<Primitive>& triangles,
                  const std::vector<Primitive>& slivers, unsigned threads) {
    const ClosedSurface closed = requireClosed(triangles, slivers, geometry.bodies[body], geometry.origin);
    Volume volume = {body, {Surface(triangles, threads), {}}, closed.size};
    for (const uint32_t shell : closed.shells) volume.solid.shells.push_back(triangleOf(triangles[shell]));
    return volume;
}

std::vector<Volume> volumesOf(const Geometry& geometry, unsigned threads) {
    const std::vector<std::vector<Primitive>> primitives = volumePrimitives(geometry, geometry.primitives),
                                              slivers = volumePrimitives(geometry, geometry.slivers);
    std::vector<Volume> volumes;
    for (uint32_t body = 0; body < geometry.bodies.size(); ++body) {
        if (!geometry.bodies[body].isVolume() || primitives[body].empty()) continue;
        const bool isSphere = primitives[body][0].isSphere;
        volumes.push_back(isSphere ? sphereVolume(body, primitives[body][0])
                                   : meshVolume(geometry, body, primitives[body], slivers[body], threads));
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

std::vector<Aabb> boxesOf(const Geometry& geometry) {
    std::vector<Aabb> boxes(geometry.bodies.size());
    for (const Primitive& primitive : geometry.primitives) boxes[primitive.body].grow(bounds(primitive));
    return boxes;
}

/// The least number k such that every set of volumes has one that overlaps at most k others of the set: no k + 2 volumes all overlap one another.
uint32_t degeneracy(const std::vector<std::vector<uint32_t>>& neighbours) {
    std::set<IndexPair> left;  // degree and volume
    std::vector<uint32_t> degree;
    for (const std::vector<uint32_t>& list : neighbours) {
        left.emplace(static_cast<uint32_t>(list.size()), static_cast<uint32_t>(degree.size()));
        degree.push_back(static_cast<uint32_t>(list.size()));
    }
    uint32_t result = 0;
    while (!left.empty()) {
        const auto [least, volume] = *left.begin();
        left.erase(left.begin());
        result = std::max(result, least);
        for (const uint32_t other : neighbours[volume])
            if (left.erase({degree[other], other}) > 0) left.emplace(--degree[other], other);
    }
    return result;
}

constexpr size_t kShownPairs = 8;  // warnings of a kind

/// A volume and another body, which may be a volume.
struct Neighbours {
    uint32_t body, volume;  // index into Geometry::bodies; into the list of volumes
};

class Analysis {
public:
    Analysis(const Scene& scene, const Geometry& geometry, Diagnostics& diagnostics, unsigned threads)
        : scene_(scene),
          geometry_(geometry),
          diagnostics_(diagnostics),
          threads_(threads),
          volumes_(volumesOf(geometry, threads)) {}

    Volumes run() {
        makeOrder();
        result_.count = static_cast<uint32_t>(volumes_.size());
        overlaps_.resize(volumes_.size());
        if (volumes_.empty()) return std::move(result_);
        findNeighbours();
        compareVolumes();
        findSelfOverlap();
        findLightsInside();
        compareOthers();
        warnOfMore();
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

    /// By their boxes.
    void findNeighbours() {
        std::vector<uint32_t> volumeOf(geometry_.bodies.size(), kNone);
        for (uint32_t i = 0; i < volumes_.size(); ++i) volumeOf[volumes_[i].body] = i;
        const auto wanted = [&](uint32_t a, uint32_t b) { return volumeOf[a] != kNone || volumeOf[b] != kNone; };
        const Aabb all{geometry_.boundsMin, geometry_.boundsMax};
        for (const auto& [a, b] : nearPairs(boxesOf(geometry_), 2 * offsetBound(all, all), wanted)) {
            if (volumeOf[a] != kNone && volumeOf[b] != kNone)
                volumePairs_.emplace_back(volumeOf[a], volumeOf[b]);
            else
                others_.push_back(volumeOf[a] == kNone ? Neighbours{a, volumeOf[b]} : Neighbours{b, volumeOf[a]});
        }
        std::sort(others_.begin(), others_.end(), [](const Neighbours& a, const Neighbours& b) {
            return std::tie(a.body, a.volume) < std::tie(b.body, b.volume);
        });
    }

    struct Comparison {
        Overlap overlap = Overlap::none;
        double contact = 0;  // where the surfaces lie on each other: how near counts
    };

    static Comparison compare(const Volume& a, const Volume& b) {
        return {overlapOf(a.solid, b.solid), contactOf(a.surface(), b.surface())};
    }

    void compareVolumes() {
        std::vector<Comparison> comparisons(volumePairs_.size());
        ThreadPool(threads_).parallelFor(volumePairs_.size(), [&](size_t i) {
            comparisons[i] = compare(volumes_[volumePairs_[i].first], volumes_[volumePairs_[i].second]);
        });
        for (size_t i = 0; i < comparisons.size(); ++i) note(volumePairs_[i].first, volumePairs_[i].second, comparisons[i]);
    }

    void note(uint32_t i, uint32_t k, const Comparison& comparison) {
        const Volume &a = volumes_[i], &b = volumes_[k];
        if (comparison.contact > 0)
            warnOfContact(bodyOf(a), bodyOf(b), bodyOf(b).location,
                          "let the two overlap by more than " + metres(comparison.contact));
        const Overlap overlap = comparison.overlap;
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

    /// A little more than a distance that is too short.
    static std::string metres(double distance) { return toText("%.2g m", 1.05 * distance); }

    void warnOfContact(const Body& a, const Body& b, const SourceLocation& location, const std::string& hint) {
        if (contacts_++ >= kShownPairs) return;
        diagnostics_.warn(location,
                          "faces of " + a.name + " and " + b.name +
                              " lie on each other, or nearer than rounding can tell: a ray may pass over one of them",
                          hint);
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
                diagnostics_.warn({scene_.path}, std::to_string(count - kShownPairs) + " more pairs of " + what, hint);
        };
        more(contacts_, "bodies have faces that lie on each other, or nearer than rounding can tell", "let them overlap");
        more(guesses_, "volumes overlap and are of like size", "--explain lists them");
    }

    void findSelfOverlap() {
        for (const Volume& volume : volumes_) {
            const Body& body = bodyOf(volume);
            if (isInsideOutInPart(volume.solid))
                diagnostics_.warn(body.location, body.name + " is inside out in part: a piece of it has its front inside",
                                  "wind all faces counter-clockwise as seen from outside");
            if (result_.selfOverlap.empty() && overlapsItself(volume.solid, threads_))
                result_.selfOverlap = body.name + " overlaps itself";
        }
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

    /// Volumes with what is none.
    void compareOthers() {
        std::vector<std::vector<Primitive>> near = primitivesNearVolumes();
        std::vector<std::optional<Surface>> surfaces(near.size());
        for (size_t body = 0; body < near.size(); ++body)
            if (!near[body].empty()) surfaces[body].emplace(std::move(near[body]), threads_);
        std::vector<double> contacts(others_.size());
        ThreadPool(threads_).parallelFor(others_.size(), [&](size_t i) {
            if (const std::optional<Surface>& thing = surfaces[others_[i].body])
                contacts[i] = contactOf(*thing, volumes_[others_[i].volume].surface());
        });
        for (size_t i = 0; i < others_.size(); ++i) {
            const Volume& volume = volumes_[others_[i].volume];
            const Body& body = geometry_.bodies[others_[i].body];
            if (contacts[i] > 0)
                warnOfContact(bodyOf(volume), body, bodyOf(volume).location,
                              "move one so that they are more than " + metres(contacts[i]) + " apart, or overlap by more");
            const std::optional<Surface>& thing = surfaces[others_[i].body];
            if (result_.content.empty() && thing && isContent(*thing, volume.surface()))
                result_.content = body.name + " in " + bodyOf(volume).name;
        }
    }

    /// How near counts where the surfaces lie on each other, else 0.
    static double contactOf(const Surface& a, const Surface& b) {
        const double distance = 2 * offsetBound(a.box(), b.box());
        return lieOnEachOther(a, b, distance) ? distance : 0;
    }

    /// Of each body that is no volume: what is near the box of a volume.
    std::vector<std::vector<Primitive>> primitivesNearVolumes() const {
        std::vector<std::vector<uint32_t>> volumesNear(geometry_.bodies.size());
        for (const Neighbours& pair : others_) volumesNear[pair.body].push_back(pair.volume);
        std::vector<std::vector<Primitive>> near(geometry_.bodies.size());
        for (const Primitive& primitive : geometry_.primitives) {
            const std::vector<uint32_t>& candidates = volumesNear[primitive.body];
            const Aabb box = bounds(primitive);
            const auto isNear = [&](uint32_t volume) {
                const Aabb& other = volumes_[volume].surface().box();
                return areNear(box, other, 2 * offsetBound(box, other));
            };
            if (std::any_of(candidates.begin(), candidates.end(), isNear)) near[primitive.body].push_back(primitive);
        }
        return near;
    }

    void makeCapacity() {
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
    unsigned threads_;
    std::vector<Volume> volumes_;
    std::vector<IndexPair> volumePairs_;           // that may touch, as indices into volumes_
    std::vector<Neighbours> others_;               // the same of a volume and what is none
    std::vector<std::vector<uint32_t>> overlaps_;  // of each volume
    size_t contacts_ = 0, guesses_ = 0;            // pairs that a warning tells of
    Volumes result_;
};

}  // namespace

Volumes analyseVolumes(const Scene& scene, const Geometry& geometry, Diagnostics& diagnostics, unsigned threads) {
    return Analysis(scene, geometry, diagnostics, threads).run();
}

}  // namespace minirtc
