#include "volume_overlap.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

constexpr double kRounding = 1e-12;  // of distances in double, relative: below it, surfaces touch

Meeting meetSpheres(const Primitive& a, const Primitive& b) {
    const double ra = a.p[1].x, rb = b.p[1].x, distance = glm::length(glm::dvec3(a.p[0]) - glm::dvec3(b.p[0]));
    const double margin = kRounding * (ra + rb);
    if (distance > ra + rb + margin || distance < std::fabs(ra - rb) - margin) return Meeting::apart;
    return distance < ra + rb - margin && distance > std::fabs(ra - rb) + margin ? Meeting::crossing : Meeting::grazing;
}

Meeting meetSphere(const Primitive& sphere, const Primitive& triangle) {
    const double radius = sphere.p[1].x;
    const DistanceRange range = distances(glm::dvec3(sphere.p[0]), triangleOf(triangle));
    const double inner = radius * (1 - kRounding), outer = radius * (1 + kRounding);
    if (range.nearest > outer || range.farthest < inner) return Meeting::apart;
    return range.nearest < inner && range.farthest > outer ? Meeting::crossing : Meeting::grazing;
}

Contact meetPrimitives(const Primitive& a, const Primitive& b) {
    if (a.isSphere && b.isSphere) return {meetSpheres(a, b), {}};
    if (a.isSphere) return {meetSphere(a, b), {}};
    if (b.isSphere) return {meetSphere(b, a), {}};
    return meet(triangleOf(a), triangleOf(b));
}

std::optional<bool> isInside(const Surface& volume, const glm::dvec3& point) {
    const std::optional<int> winding = volume.windingAt(point);
    if (!winding) return std::nullopt;
    return *winding > 0;
}

/// A point of the primitive, or behind it by `depth` relative to its size.
glm::dvec3 pointOf(const Primitive& primitive, double depth) {
    if (primitive.isSphere) {
        const glm::dvec3 somewhere = glm::normalize(glm::dvec3(0.4243, 0.5657, -0.7071));
        return glm::dvec3(primitive.p[0]) + somewhere * (double{primitive.p[1].x} * (1 - depth));
    }
    const Triangle t = triangleOf(primitive);
    const glm::dvec3 area = areaVector(t);
    return (t[0] + t[1] + t[2]) / 3.0 - area * (depth / std::sqrt(glm::length(area)));
}

/// Whether a primitive that does not cross the volume is in it; nothing where it lies on its surface.
using Judge = std::function<std::optional<bool>(const Primitive&)>;

struct Sides {
    bool inside = false;   // some of it is
    bool outside = false;  // some of it is
};

/// Where a surface is that does not cross the volume's: a box that the volume's surface does not touch is on one side with all in it.
/// Ends early where `done`.
template <typename Done>
Sides sidesOf(const Surface& surface, const Surface& volume, const Judge& judge, const Done& done) {
    Sides sides;
    std::vector<BvhChild> open = {surface.root()};
    const auto note = [&](const std::optional<bool>& inside) {
        sides.inside = sides.inside || inside.value_or(false);
        sides.outside = sides.outside || !inside.value_or(true);
    };
    while (!open.empty() && !done(sides)) {
        const BvhChild child = open.back();
        open.pop_back();
        if (!(child.box.lo.x <= child.box.hi.x)) continue;
        if (!areNear(child.box, volume.box(), 0)) {
            sides.outside = true;
        } else if (!volume.mayTouch(child.box)) {
            note(isInside(volume, 0.5 * (glm::dvec3(child.box.lo) + glm::dvec3(child.box.hi))));
        } else if (child.count > 0) {
            for (uint32_t i = child.index; i < child.index + child.count; ++i) note(judge(surface.primitives()[i]));
        } else {
            const BvhNode& node = surface.bvh().nodes[child.index];
            open.insert(open.end(), {node.child[1], node.child[0]});
        }
    }
    return sides;
}

constexpr double kDepths[] = {1e-3, 3e-5, 1e-6};  // of points taken for what is right behind a surface

/// A point right behind the primitive stands for it, so that surfaces which lie on each other leave no doubt.
std::optional<bool> isInsideBehind(const Primitive& primitive, const Surface& own, const Surface& volume) {
    for (const double depth : kDepths) {
        const glm::dvec3 point = pointOf(primitive, depth);
        if (isInside(own, point).value_or(false)) return isInside(volume, point);
    }
    return std::nullopt;
}

/// Asks of points around one where edges touch.
bool anyNear(const glm::dvec3& point, double size, const std::function<bool(const glm::dvec3&)>& question) {
    for (int i = 0; i < 27; ++i) {
        const int x = i % 3, y = i / 3 % 3, z = i / 9;
        const glm::ivec3 step(x - 1, y - 1, z - 1);
        // Turned a little out of the axes, along which edges tend to run.
        const glm::dvec3 direction = glm::dvec3(step) + glm::dvec3(0.0713, -0.1319, 0.1931);
        if (question(point + direction * (kDepths[0] * size))) return true;
    }
    return false;
}

/// Of the smaller of two triangles.
double sizeOf(const Primitive& a, const Primitive& b) {
    return std::sqrt(std::min(glm::length(areaVector(triangleOf(a))), glm::length(areaVector(triangleOf(b)))));
}

/// crossing, touching (in no more than points, edges and faces from outside) or apart.
Meeting meetSurfaces(const Surface& a, const Surface& b) {
    bool touch = false;
    const auto inBoth = [&](const glm::dvec3& point) {
        return isInside(a, point).value_or(false) && isInside(b, point).value_or(false);
    };
    const bool cross = anyPair(a, b, 0, [&](const Primitive& p, const Primitive& q) {
        const Contact contact = meetPrimitives(p, q);
        touch = touch || contact.meeting != Meeting::apart;
        if (contact.meeting == Meeting::touching) return anyNear(contact.point, sizeOf(p, q), inBoth);
        return contact.meeting == Meeting::crossing || contact.meeting == Meeting::sameFront;
    });
    return cross ? Meeting::crossing : touch ? Meeting::touching : Meeting::apart;
}

/// Of surfaces that are apart, each shell is on one side as a whole.
Sides sidesOfShells(const Solid& solid, const Surface& volume) {
    Sides sides;
    for (const Triangle& shell : solid.shells) {
        const bool inside = isInside(volume, shell[0]).value_or(false);
        sides.inside = sides.inside || inside;
        sides.outside = sides.outside || !inside;
    }
    return sides;
}

Sides sidesOfSolid(const Solid& a, const Surface& b, Meeting meeting) {
    if (meeting == Meeting::apart && !a.shells.empty()) return sidesOfShells(a, b);
    return sidesOf(
        a.surface, b, [&](const Primitive& primitive) { return isInsideBehind(primitive, a.surface, b); },
        [](const Sides& sides) { return sides.inside && sides.outside; });
}

bool boxesShareSpace(const Aabb& a, const Aabb& b) {
    for (int i = 0; i < 3; ++i)
        if (!(a.lo[i] < b.hi[i] && b.lo[i] < a.hi[i])) return false;
    return true;
}

bool spheresLieOnEachOther(const Primitive& a, const Primitive& b, double distance) {
    const double ra = a.p[1].x, rb = b.p[1].x, between = glm::length(glm::dvec3(a.p[0]) - glm::dvec3(b.p[0]));
    const bool alike = between + std::fabs(ra - rb) <= distance;
    const bool thin = between < ra + rb && ra + rb - between <= distance;
    return alike || thin;
}

}  // namespace

Overlap overlapOf(const Solid& a, const Solid& b) {
    if (!boxesShareSpace(a.surface.box(), b.surface.box())) return Overlap::none;
    const Meeting meeting = meetSurfaces(a.surface, b.surface);
    if (meeting == Meeting::crossing) return Overlap::partial;
    const Sides ofA = sidesOfSolid(a, b.surface, meeting), ofB = sidesOfSolid(b, a.surface, meeting);
    if (!ofA.inside && !ofB.inside) return Overlap::none;
    if (ofA.inside && !ofA.outside && !ofB.inside) return Overlap::firstInside;
    if (ofB.inside && !ofB.outside && !ofA.inside) return Overlap::secondInside;
    return Overlap::partial;
}

bool isContent(const Surface& thing, const Surface& volume) {
    if (!areNear(thing.box(), volume.box(), 0)) return false;
    const bool meets = anyPair(thing, volume, 0, [](const Primitive& p, const Primitive& q) {
        const Meeting meeting = meetPrimitives(p, q).meeting;
        return meeting != Meeting::apart && meeting != Meeting::grazing;
    });
    if (meets) return true;
    const auto judge = [&](const Primitive& primitive) { return isInside(volume, pointOf(primitive, 0)); };
    return sidesOf(thing, volume, judge, [](const Sides& sides) { return sides.inside; }).inside;
}

bool overlapsItself(const Solid& solid, unsigned threads) {
    const auto isInTwice = [&](const glm::dvec3& point) { return solid.surface.windingAt(point).value_or(0) > 1; };
    const auto cross = [&](const Primitive& p, const Primitive& q) {
        const Contact contact = meetPrimitives(p, q);
        if (contact.meeting == Meeting::touching) return anyNear(contact.point, sizeOf(p, q), isInTwice);
        return contact.meeting == Meeting::crossing || contact.meeting == Meeting::sameFront;
    };
    if (anyPairWithin(solid.surface, cross, threads)) return true;
    return std::any_of(solid.shells.begin(), solid.shells.end(),
                       [&](const Triangle& shell) { return solid.surface.windingBefore(shell).value_or(0) != 0; });
}

bool isInsideOutInPart(const Solid& solid) {
    return std::any_of(solid.shells.begin(), solid.shells.end(),
                       [&](const Triangle& shell) { return solid.surface.windingBefore(shell).value_or(0) < 0; });
}

bool lieOnEachOther(const Surface& a, const Surface& b, double distance) {
    return anyPair(a, b, distance, [&](const Primitive& p, const Primitive& q) {
        if (p.isSphere && q.isSphere) return spheresLieOnEachOther(p, q, distance);
        return !p.isSphere && !q.isSphere && lieOnEachOther(triangleOf(p), triangleOf(q), distance);
    });
}

}  // namespace minirtc
