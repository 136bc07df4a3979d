#include "oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace oracle {
namespace {

constexpr uint32_t kLeafSize = 4;

bool before(const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;
#else
using Quad = long double;  // where there is no other, it tends to be this one
#endif

/// direction . (edge x fromOrigin) for the edge from a to b.
template <typename Real>
Real tripleProduct(const glm::vec3& a, const glm::vec3& b, const Ray& ray) {
    Real d[3], e[3], f[3];
    for (int i = 0; i < 3; ++i) d[i] = ray.direction[i], e[i] = Real(b[i]) - Real(a[i]), f[i] = Real(a[i]) - Real(ray.origin[i]);
    return d[0] * (e[1] * f[2] - e[2] * f[1]) + d[1] * (e[2] * f[0] - e[0] * f[2]) + d[2] * (e[0] * f[1] - e[1] * f[0]);
}

/// Six times the signed volume of the tetrahedron over the edge and the unit of the ray; exactly the negative for the reversed
/// edge. Where double could err about the sign it is computed in 113 bits, which is exact unless exponents lie far apart: signs
/// that err would contradict one another around a vertex and open a hole there.
double edgeVolume(const glm::vec3& a, const glm::vec3& b, const Ray& ray) {
    if (before(b, a)) return -edgeVolume(b, a, ray);
    constexpr double kErrorBound = 1e-14;
    const double volume = tripleProduct<double>(a, b, ray);
    const double edge = glm::distance(glm::dvec3(a), glm::dvec3(b)),
                 fromOrigin = glm::distance(glm::dvec3(a), glm::dvec3(ray.origin));
    const bool isSure = std::abs(volume) > kErrorBound * glm::length(glm::dvec3(ray.direction)) * edge * fromOrigin;
    return isSure ? volume : static_cast<double>(tripleProduct<Quad>(a, b, ray));
}

/// Makes `hit` the triangle's where that one is nearer.
void keepClosest(const Triangle& triangle, uint32_t primitive, const Ray& ray, JudgedHit& hit) {
    const auto [a, b, c] = triangle;
    const double u = edgeVolume(b, c, ray), v = edgeVolume(c, a, ray), w = edgeVolume(a, b, ray);
    if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return;
    const glm::dvec3 direction(ray.direction), toPlane = glm::dvec3(a) - glm::dvec3(ray.origin);
    const glm::dvec3 normal = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double det = glm::dot(normal, direction);
    if (det == 0) return;
    const double t = glm::dot(normal, toPlane) / det;
    if (t < ray.tMin || t > ray.tMax || t > hit.t || (t == hit.t && primitive > hit.primitive)) return;
    hit.t = t;
    hit.primitive = primitive;
    hit.cosTheta = std::abs(det) / (glm::length(normal) * glm::length(direction));
}

/// The distance between the ray from tMin to `end` and the edge [Ericson 2005, Real-Time Collision Detection, 5.1.9].
double distanceToEdge(const glm::dvec3& p, const glm::dvec3& q, const Ray& ray, double end) {
    const glm::dvec3 direction(ray.direction), edge = q - p, r = glm::dvec3(ray.origin) - p;
    const auto onRay = [&](double t) { return std::min(std::max(t, double(ray.tMin)), end); };
    const double a = glm::dot(direction, direction), b = glm::dot(direction, edge), c = glm::dot(direction, r);
    const double e = glm::dot(edge, edge), f = glm::dot(edge, r), denominator = a * e - b * b;
    double t = denominator > 0 ? onRay((b * f - c * e) / denominator) : ray.tMin;
    double s = e > 0 ? (b * t + f) / e : 0;
    if (s <= 0 || s >= 1) {
        s = s <= 0 ? 0 : 1;
        t = onRay((b * s - c) / a);
    }
    return glm::length(r + t * direction - s * edge);
}

void keepClearance(const Triangle& triangle, const Ray& ray, double end, double& clearance) {
    for (int i = 0; i < 3; ++i)
        clearance = std::min(clearance, distanceToEdge(glm::dvec3(triangle[i]), glm::dvec3(triangle[(i + 1) % 3]), ray, end));
}

glm::dvec3 lowest(const Triangle& t) {
    return glm::dvec3(glm::min(t[0], glm::min(t[1], t[2])));
}
glm::dvec3 highest(const Triangle& t) {
    return glm::dvec3(glm::max(t[0], glm::max(t[1], t[2])));
}

}  // namespace

DoubleScene::DoubleScene(Mesh mesh) : mesh_(std::move(mesh)), order_(mesh_.size()) {
    glm::dvec3 lo = lowest(mesh_.at(0)), hi = highest(mesh_.at(0));
    for (const Triangle& triangle : mesh_) lo = glm::min(lo, lowest(triangle)), hi = glm::max(hi, highest(triangle));
    maxClearance_ = 1e-4 * glm::length(hi - lo);
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, 0, static_cast<uint32_t>(mesh_.size()));
}

/// Padded so that a ray which comes nearer than maxClearance_ meets the box.
DoubleScene::Box DoubleScene::paddedBounds(const Triangle& triangle) const {
    const glm::dvec3 padding(1.01 * maxClearance_);
    return {lowest(triangle) - padding, highest(triangle) + padding};
}

void DoubleScene::build(size_t node, uint32_t begin, uint32_t end) {
    if (nodes_.size() <= node) nodes_.resize(node + 1);
    constexpr double inf = std::numeric_limits<double>::infinity();
    Box box{glm::dvec3(inf), glm::dvec3(-inf)};
    for (uint32_t i = begin; i < end; ++i) {
        const Box b = paddedBounds(mesh_[order_[i]]);
        box = {glm::min(box.lo, b.lo), glm::max(box.hi, b.hi)};
    }
    nodes_[node] = {box, begin, end};
    if (end - begin <= kLeafSize) return;
    const glm::dvec3 size = box.hi - box.lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto key = [&](uint32_t i) { return double(mesh_[i][0][axis]) + mesh_[i][1][axis] + mesh_[i][2][axis]; };
    const uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t i, uint32_t j) { return key(i) < key(j); });
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
}

/// The slab test, a little generous: each step rounds once.
bool DoubleScene::meets(const Box& box, const Ray& ray, double tMax) {
    constexpr double kSlack = 1e-14;
    double begin = ray.tMin, end = tMax;
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis], direction = ray.direction[axis];
        if (direction == 0) {
            if (origin < box.lo[axis] || origin > box.hi[axis]) return false;
            continue;
        }
        const double t0 = (box.lo[axis] - origin) / direction, t1 = (box.hi[axis] - origin) / direction;
        const double enter = std::min(t0, t1), leave = std::max(t0, t1);
        begin = std::max(begin, enter - kSlack * std::abs(enter));
        end = std::min(end, leave + kSlack * std::abs(leave));
    }
    return begin <= end;
}

/// Calls visit(primitive) at least for all that the ray comes near to up to `end`, which `visit` may bring nearer.
template <typename Visit>
void DoubleScene::visitNear(size_t node, const Ray& ray, const double& end, const Visit& visit) const {
    const Node& n = nodes_[node];
    if (!meets(n.box, ray, end)) return;
    if (n.end - n.begin <= kLeafSize) {
        for (uint32_t i = n.begin; i < n.end; ++i) visit(order_[i]);
        return;
    }
    visitNear(2 * node + 1, ray, end, visit);
    visitNear(2 * node + 2, ray, end, visit);
}

JudgedHit DoubleScene::closestHit(const Ray& ray) const {
    JudgedHit hit;
    visitNear(0, ray, hit.t, [&](uint32_t i) { keepClosest(mesh_[i], i, ray, hit); });
    hit.clearance = maxClearance_;
    const double end = std::min<double>(hit.t, ray.tMax);
    visitNear(0, ray, end, [&](uint32_t i) { keepClearance(mesh_[i], ray, end, hit.clearance); });
    return hit;
}

JudgedHit DoubleScene::closestHitLinear(const Ray& ray) const {
    JudgedHit hit;
    for (uint32_t i = 0; i < mesh_.size(); ++i) keepClosest(mesh_[i], i, ray, hit);
    hit.clearance = maxClearance_;
    const double end = std::min<double>(hit.t, ray.tMax);
    for (uint32_t i = 0; i < mesh_.size(); ++i) keepClearance(mesh_[i], ray, end, hit.clearance);
    return hit;
}

}  // namespace oracle
