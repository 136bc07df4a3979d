#include "split_oracle.hpp"

#include <algorithm>
#include <cmath>

#include "scene_text.hpp"

using glm::dvec3;

namespace test {
namespace {

oracle::Mesh meshOf(const std::vector<SplitFace>& faces) {
    oracle::Mesh mesh;
    for (const SplitFace& face : faces) mesh.push_back({glm::vec3(face.a), glm::vec3(face.b), glm::vec3(face.c)});
    return mesh;
}

double sizeOf(const std::vector<SplitFace>& faces) {
    double size = 0;
    for (const SplitFace& face : faces)
        for (const dvec3& p : {face.a, face.b, face.c}) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return size;
}

}  // namespace

dvec3 litWall(const dvec3& p, const dvec3& d) {
    const double t = (-6 - p.z) / d.z;
    if (!(d.z < 0)) return dvec3(0.25);
    const dvec3 q = p + t * d;
    if (std::abs(q.x) > 30 || std::abs(q.y) > 30) return dvec3(0.25);
    const double d2 = 4 + q.x * q.x + q.y * q.y;
    return dvec3(0.5 * 40 * 2 / std::sqrt(d2) / d2);
}

SplitScene::SplitScene(const std::vector<SplitFace>& faces, std::vector<SplitMedium> media,
                       std::function<dvec3(const dvec3&, const dvec3&)> surroundings,
                       std::function<Sides(const SplitFace&, const dvec3&)> sidesAt)
    : faces_(faces),
      media_(std::move(media)),
      surroundings_(std::move(surroundings)),
      sidesAt_(std::move(sidesAt)),
      scene_(meshOf(faces)),
      nearest_(2e-6 * sizeOf(faces)) {}

dvec3 SplitScene::radiance(const dvec3& p, const dvec3& d, int maxDepth) {
    maxDepth_ = maxDepth;
    return follow(p, d, dvec3(1), 0, 0);
}

dvec3 SplitScene::follow(dvec3 p, const dvec3& d, const dvec3& throughput, int medium, int depth) {
    const oracle::JudgedHit hit =
        scene_.closestHit({glm::vec3(p), static_cast<float>(nearest_), glm::vec3(d), oracle::kInfinity});
    if (hit.primitive == oracle::kNone) return throughput * surroundings_(p, d);
    p += hit.t * d;
    const dvec3 left = throughput * glm::exp(-media_[medium].sigma * hit.t);
    const SplitFace& face = faces_[hit.primitive];
    const Sides sides = sidesAt_ ? sidesAt_(face, p) : Sides{face.front, face.back};
    if (sides.front == sides.back) return follow(p, d, left, medium, depth);
    const dvec3 out = glm::normalize(glm::cross(face.b - face.a, face.c - face.a));
    const bool fromFront = glm::dot(d, out) < 0;
    const int from = fromFront ? sides.front : sides.back, to = fromFront ? sides.back : sides.front;
    misfits_ += medium == from ? 0 : 1;
    if (depth == maxDepth_) return dvec3(0);
    const dvec3 n = fromFront ? out : -out;
    const double cosI = -glm::dot(d, n), eta = media_[to].ior / media_[from].ior;
    const double k = 1 - (1 - cosI * cosI) / (eta * eta), r = fresnel(cosI, eta);
    const auto carriesOn = [](const dvec3& weight) { return std::max({weight.x, weight.y, weight.z}) > 1.0 / 512; };
    dvec3 sum(0);
    if (carriesOn(left * r)) sum += follow(p, d + 2 * cosI * n, left * r, from, depth + 1);
    if (k > 0 && carriesOn(left * (1 - r)))
        sum += follow(p, glm::normalize(d / eta + n * (cosI / eta - std::sqrt(k))), left * (1 - r), to, depth + 1);
    return sum;
}

}  // namespace test
