#include "closed_surface.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numeric>

namespace minirtc {
namespace {

/// A number for each position that occurs.
class Weld {
public:
    explicit Weld(size_t corners) {
        size_t size = 16;
        while (size < 2 * corners) size *= 2;
        slots_.assign(size, kNone);
    }

    uint32_t operator()(const glm::vec3& p) {
        for (size_t slot = hash(p) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
            if (slots_[slot] == kNone) {
                slots_[slot] = static_cast<uint32_t>(positions_.size());
                positions_.push_back(p);
            }
            if (positions_[slots_[slot]] == p) return slots_[slot];
        }
    }
    const glm::vec3& position(uint32_t vertex) const { return positions_[vertex]; }

private:
    static size_t hash(const glm::vec3& p) {
        uint64_t h = 0;
        for (int i = 0; i < 3; ++i) {
            const float normal = p[i] + 0.0f;  // -0 is 0
            uint32_t bits = 0;
            std::memcpy(&bits, &normal, sizeof bits);
            h = (h ^ bits) * 0x9e3779b97f4a7c15u;
            h ^= h >> 32;
        }
        return h;
    }

    std::vector<uint32_t> slots_;
    std::vector<glm::vec3> positions_;
};

/// An edge of a face, from vertex to vertex. Sorted, all uses of an edge stand together, in either direction.
struct EdgeUse {
    uint32_t low, high;
    uint32_t face;
    bool forward;  // from low to high
    bool operator<(const EdgeUse& other) const {
        return std::tie(low, high, face, forward) < std::tie(other.low, other.high, other.face, other.forward);
    }
    bool isSameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// Which faces hang together.
class Groups {
public:
    explicit Groups(size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t find(uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(uint32_t a, uint32_t b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

private:
    std::vector<uint32_t> parent_;
};

class EdgeTable {
public:
    EdgeTable(const std::vector<Primitive>& triangles, const std::vector<Primitive>& slivers)
        : weld_(3 * (triangles.size() + slivers.size())), groups_(triangles.size() + slivers.size()) {
        uses_.reserve(3 * triangles.size());
        for (uint32_t i = 0; i < triangles.size(); ++i) add(triangles[i], i);
        match();
        if (isClosed() || slivers.empty()) return;
        for (uint32_t i = 0; i < slivers.size(); ++i) add(slivers[i], static_cast<uint32_t>(triangles.size()) + i);
        match();
    }

    bool isClosed() const { return open_.empty() && unbalanced_.empty(); }
    /// Edges of one face only; and those of several that do not run as often one way as the other. In the order of the faces.
    const std::vector<EdgeUse>& open() const { return open_; }
    const std::vector<EdgeUse>& unbalanced() const { return unbalanced_; }
    const glm::vec3& position(uint32_t vertex) const { return weld_.position(vertex); }
    uint32_t groupOf(uint32_t face) { return groups_.find(face); }

private:
    void add(const Primitive& triangle, uint32_t face) {
        const std::array<uint32_t, 3> v = {weld_(triangle.p[0]), weld_(triangle.p[1]), weld_(triangle.p[2])};
        for (int i = 0; i < 3; ++i) {
            const uint32_t from = v[i], to = v[(i + 1) % 3];
            if (from != to) uses_.push_back({std::min(from, to), std::max(from, to), face, from < to});
        }
    }

    void match() {
        open_.clear(), unbalanced_.clear();
        std::sort(uses_.begin(), uses_.end());
        for (size_t first = 0, end = 0; first < uses_.size(); first = end) {
            int balance = 0;
            for (end = first; end < uses_.size() && uses_[end].isSameEdge(uses_[first]); ++end) {
                balance += uses_[end].forward ? 1 : -1;
                groups_.join(uses_[first].face, uses_[end].face);
            }
            if (end - first == 1)
                open_.push_back(uses_[first]);
            else if (balance != 0)
                unbalanced_.push_back(uses_[first]);
        }
        const auto byFace = [](const EdgeUse& a, const EdgeUse& b) {
            return std::tie(a.face, a.low, a.high) < std::tie(b.face, b.low, b.high);
        };
        std::sort(open_.begin(), open_.end(), byFace);
        std::sort(unbalanced_.begin(), unbalanced_.end(), byFace);
    }

    Weld weld_;
    Groups groups_;
    std::vector<EdgeUse> uses_, open_, unbalanced_;
};

std::string toText(const glm::dvec3& p) {
    char text[128];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
    return text;
}

/// "4 edges ..., (0, 0, 0) to (1, 0, 0), ..."
std::string describe(const std::vector<EdgeUse>& edges, const std::string& what, const EdgeTable& table,
                     const glm::dvec3& origin) {
    constexpr size_t kShown = 3;
    std::string text = std::to_string(edges.size()) + (edges.size() == 1 ? " edge " : " edges ") + what + ": ";
    for (size_t i = 0; i < std::min(kShown, edges.size()); ++i) {
        const glm::dvec3 from = origin + glm::dvec3(table.position(edges[i].forward ? edges[i].low : edges[i].high));
        const glm::dvec3 to = origin + glm::dvec3(table.position(edges[i].forward ? edges[i].high : edges[i].low));
        text += (i > 0 ? ", " : "") + toText(from) + " to " + toText(to);
    }
    return text + (edges.size() > kShown ? ", ..." : "");
}

glm::dvec3 areaVector(const Primitive& t) {
    const glm::dvec3 a(t.p[0]);
    return glm::cross(glm::dvec3(t.p[1]) - a, glm::dvec3(t.p[2]) - a);
}

/// By the divergence theorem, from a point nearby: far from the origin nothing cancels.
class SignedVolume {
public:
    void add(const Primitive& t) {
        if (isFirst_) reference_ = glm::dvec3(t.p[0]);
        isFirst_ = false;
        const glm::dvec3 area = areaVector(t);
        sum_ += glm::dot(glm::dvec3(t.p[0]) - reference_, area);
        areas_ += area;
        size_ += glm::length(area);
    }
    double value() const { return sum_ / 6; }
    /// The areas of a closed surface cancel; otherwise the value is not a volume.
    bool mayBeClosed() const { return glm::length(areas_) <= 1e-6 * size_; }

private:
    bool isFirst_ = true;
    glm::dvec3 reference_{0}, areas_{0};
    double sum_ = 0, size_ = 0;
};

std::vector<uint32_t> largestOfGroups(const std::vector<Primitive>& triangles, EdgeTable& table) {
    std::vector<uint32_t> largest(triangles.size(), kNone);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        uint32_t& best = largest[table.groupOf(i)];
        if (best == kNone || glm::length(areaVector(triangles[i])) > glm::length(areaVector(triangles[best]))) best = i;
    }
    largest.erase(std::remove(largest.begin(), largest.end(), kNone), largest.end());
    return largest;
}

void turn(Primitive& triangle, std::vector<CornerAttributes>& corners) {
    std::swap(triangle.p[1], triangle.p[2]);
    if (triangle.corners == kNone) return;
    CornerAttributes& attributes = corners[triangle.corners];
    std::swap(attributes.normals[1], attributes.normals[2]);
    std::swap(attributes.uvs[1], attributes.uvs[2]);
    for (glm::vec3& n : attributes.normals) n = -n;
}

/// How an open mesh can do without an inside.
std::string waysToBeThin(const Body& body) {
    if (!body.isFromMtl) return ", or give the material \"thin\": true";
    return ", or make its material a thin sheet: 'Ni 1' in the .mtl file, or name one with \"thin\": true in the scene file";
}

}  // namespace

ClosedSurface requireClosed(const std::vector<Primitive>& triangles, const std::vector<Primitive>& slivers, const Body& body,
                            const glm::dvec3& origin) {
    EdgeTable table(triangles, slivers);
    if (!table.open().empty())
        throw Error(body.location,
                    body.name + " transmits light but is not closed: " +
                        describe(table.open(), "with a face on one side only", table, origin),
                    "close the mesh" + waysToBeThin(body));
    if (!table.unbalanced().empty())
        throw Error(body.location,
                    body.name + " transmits light but its faces do not agree on where its inside is: " +
                        describe(table.unbalanced(), "along which they run the same way", table, origin),
                    "wind all faces counter-clockwise as seen from outside" + waysToBeThin(body));
    SignedVolume volume;
    for (const Primitive& triangle : triangles) volume.add(triangle);
    return {volume.value(), largestOfGroups(triangles, table)};
}

Geometry turnOutward(Geometry geometry, Diagnostics& diagnostics) {
    std::vector<SignedVolume> volumes(geometry.bodies.size());
    for (const Primitive& primitive : geometry.primitives)
        if (!primitive.isSphere && geometry.bodies[primitive.body].isVolume()) volumes[primitive.body].add(primitive);
    const auto isInsideOut = [&](uint32_t body) { return volumes[body].value() < 0 && volumes[body].mayBeClosed(); };
    for (Primitive& primitive : geometry.primitives)
        if (isInsideOut(primitive.body)) turn(primitive, geometry.corners);
    for (Primitive& sliver : geometry.slivers)
        if (isInsideOut(sliver.body)) turn(sliver, geometry.corners);
    for (uint32_t i = 0; i < geometry.bodies.size(); ++i) {
        const Body& body = geometry.bodies[i];
        if (isInsideOut(i))
            diagnostics.warn(body.location, body.name + " is inside out: its faces run clockwise as seen from outside",
                             "they are turned round");
    }
    return geometry;
}

}  // namespace minirtc
