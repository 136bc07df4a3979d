#include "triangulate.hpp"

#include <algorithm>
#include <cmath>

namespace minirtc {
namespace {

using Points = std::vector<glm::dvec2>;

/// Area vector by Newell's method, about the first corner: twice the area along the normal.
glm::dvec3 newellNormal(const std::vector<glm::dvec3>& polygon) {
    glm::dvec3 sum(0);
    for (size_t i = 1; i + 1 < polygon.size(); ++i) sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

/// Drops the axis along which the polygon is flattest: coordinates stay exact, counter-clockwise stays so.
Points project(const std::vector<glm::dvec3>& polygon) {
    const glm::dvec3 normal = newellNormal(polygon);
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    int a = (drop + 1) % 3, b = (drop + 2) % 3;
    if (normal[drop] < 0) std::swap(a, b);
    Points points;
    points.reserve(polygon.size());
    for (const glm::dvec3& p : polygon) points.emplace_back(p[a] - polygon[0][a], p[b] - polygon[0][b]);
    return points;
}

/// Twice the signed area of the triangle; zero where it is lost in rounding.
double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 u = b - a, v = c - a;
    const double left = u.x * v.y, right = u.y * v.x;
    constexpr double kRounding = 4e-16;
    const double area = left - right;
    return std::fabs(area) <= kRounding * (std::fabs(left) + std::fabs(right)) ? 0 : area;
}

bool isConvex(const Points& p) {
    const size_t n = p.size();
    for (size_t i = 0; i < n; ++i)
        if (orientation(p[i], p[(i + 1) % n], p[(i + 2) % n]) <= 0) return false;
    return true;
}

void splitQuad(const std::vector<glm::dvec3>& polygon, const Points& p, std::vector<TriangleIndices>& triangles) {
    const auto valid = [&](int a, int b, int c) { return orientation(p[a], p[b], p[c]) > 0; };
    const bool cut02 = valid(0, 1, 2) && valid(0, 2, 3), cut13 = valid(0, 1, 3) && valid(1, 2, 3);
    const glm::dvec3 d02 = polygon[2] - polygon[0], d13 = polygon[3] - polygon[1];
    const bool prefer13 = glm::dot(d13, d13) < glm::dot(d02, d02);
    if (cut13 && (prefer13 || !cut02)) {
        triangles.push_back({0, 1, 3});
        triangles.push_back({1, 2, 3});
    } else {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    }
}

/// The polygon that is left, as a ring of indices.
class Ring {
public:
    explicit Ring(const Points& points) : p_(points), previous_(points.size()), next_(points.size()), size_(points.size()) {
        const uint32_t n = static_cast<uint32_t>(points.size());
        for (uint32_t i = 0; i < n; ++i) previous_[i] = (i + n - 1) % n, next_[i] = (i + 1) % n;
    }

    size_t size() const { return size_; }
    uint32_t next(uint32_t i) const { return next_[i]; }
    TriangleIndices triangle(uint32_t tip) const { return {previous_[tip], tip, next_[tip]}; }
    double area(uint32_t tip) const { return orientation(p_[previous_[tip]], p_[tip], p_[next_[tip]]); }

    /// A strictly convex corner whose triangle holds no other corner, its border included: the cut keeps every corner.
    bool isEar(uint32_t tip) const {
        if (area(tip) <= 0) return false;
        const glm::dvec2 a = p_[previous_[tip]], b = p_[tip], c = p_[next_[tip]];
        for (uint32_t i = next_[next_[tip]]; i != previous_[tip]; i = next_[i]) {
            const glm::dvec2& q = p_[i];
            if (q == a || q == b || q == c) continue;  // a slit's or a hole's bridge
            if (orientation(a, b, q) >= 0 && orientation(b, c, q) >= 0 && orientation(c, a, q) >= 0) return false;
        }
        return true;
    }

    void remove(uint32_t i) {
        next_[previous_[i]] = next_[i];
        previous_[next_[i]] = previous_[i];
        --size_;
    }

private:
    const Points& p_;
    std::vector<uint32_t> previous_, next_;
    size_t size_;
};

/// Among the corners left when none is an ear, the one that does least harm: without area, else convex, else any.
uint32_t leastBadTip(const Ring& ring, uint32_t start) {
    uint32_t convex = start;
    for (uint32_t i = start, n = 0; n < ring.size(); ++n, i = ring.next(i)) {
        if (ring.area(i) == 0) return i;
        if (ring.area(i) > 0) convex = i;
    }
    return convex;
}

void clipEars(const Points& points, std::vector<TriangleIndices>& triangles) {
    Ring ring(points);
    uint32_t at = 0;
    while (ring.size() > 3) {
        size_t tried = 0;
        while (tried < ring.size() && !ring.isEar(at)) at = ring.next(at), ++tried;
        const uint32_t tip = tried < ring.size() ? at : leastBadTip(ring, at);
        at = ring.next(tip);
        triangles.push_back(ring.triangle(tip));
        ring.remove(tip);
        at = ring.next(at);  // spread the cuts round the ring: no fan of needles
    }
    triangles.push_back(ring.triangle(at));
}

void fan(size_t size, std::vector<TriangleIndices>& triangles) {
    for (uint32_t i = 1; i + 1 < size; ++i) triangles.push_back({0, i, i + 1});
}

}  // namespace

bool triangulate(const std::vector<glm::dvec3>& polygon, std::vector<TriangleIndices>& triangles) {
    constexpr size_t kMostCornersForEars = 4096;
    if (polygon.size() <= 3) return fan(polygon.size(), triangles), true;
    const Points points = project(polygon);
    if (polygon.size() == 4) return splitQuad(polygon, points, triangles), true;
    if (isConvex(points)) return fan(polygon.size(), triangles), true;
    if (polygon.size() > kMostCornersForEars) return false;
    clipEars(points, triangles);
    return true;
}

}  // namespace minirtc
