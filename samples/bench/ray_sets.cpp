#include "ray_sets.hpp"

#include <cmath>
#include <utility>

namespace bench {
namespace {

constexpr uint32_t kTile = 8;
constexpr float kFieldOfView = 0.9f;     // vertical, radians
constexpr float kEyeDistance = 1.9f;     // in radii of the mesh, as the lengths below
constexpr float kLift = 1e-4f;           // of secondary rays off the surface
constexpr float kLightHalfSize = 0.25f;  // of the cube that shines
const glm::vec3 kTowardsEye(0.5f, 0.35f, 1.0f);
const glm::vec3 kTowardsLight(2.0f, 3.0f, 1.0f);

/// A random number of 32 bits for each counter [Steele, Lea and Flood 2014, SplitMix64].
uint32_t randomBits(uint64_t counter) {
    uint64_t z = (counter + 1) * 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return static_cast<uint32_t>((z ^ (z >> 31)) >> 32);
}

/// Numbers in [0,1) of one ray.
class Random {
public:
    Random(uint32_t seed, uint64_t ray) : counter_((uint64_t{seed} << 40) + ray * 8) {}
    float uniform() { return static_cast<float>(randomBits(counter_++) >> 8) * 0x1p-24f; }

private:
    uint64_t counter_;
};

glm::vec3 onSphere(Random& random) {
    const float z = 1 - 2 * random.uniform(), phi = 6.28318531f * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// A unit normal plus a point of the unit sphere is cosine-weighted around it.
glm::vec3 cosineWeighted(const glm::vec3& normal, Random& random) {
    const glm::vec3 sum = normal + onSphere(random);
    const float length = glm::length(sum);
    return length > 1e-6f ? sum / length : normal;
}

}  // namespace

Surroundings surroundingsOf(const Triangles& mesh) {
    glm::vec3 lo(kRayEnd), hi(-kRayEnd);
    for (const Triangle& triangle : mesh)
        for (const glm::vec3& p : triangle) lo = glm::min(lo, p), hi = glm::max(hi, p);
    return {0.5f * (lo + hi), 0.5f * glm::length(hi - lo)};
}

std::vector<Ray> primaryRays(const Surroundings& mesh, uint32_t width, uint32_t height) {
    const glm::vec3 eye = mesh.center + glm::normalize(kTowardsEye) * (kEyeDistance * mesh.radius);
    const glm::vec3 forward = glm::normalize(mesh.center - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    const float halfHeight = std::tan(0.5f * kFieldOfView);
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    std::vector<Ray> rays;
    rays.reserve(size_t{width} * height);
    for (uint32_t tile = 0; tile < (width / kTile) * (height / kTile); ++tile)
        for (uint32_t i = 0; i < kTile * kTile; ++i) {
            const uint32_t x = tile % (width / kTile) * kTile + i % kTile, y = tile / (width / kTile) * kTile + i / kTile;
            const float across = (2 * (static_cast<float>(x) + 0.5f) - w) / h, down = 2 * (static_cast<float>(y) + 0.5f) / h - 1;
            rays.push_back({eye, 0, glm::normalize(forward + halfHeight * (across * right - down * up)), kRayEnd});
        }
    return rays;
}

SecondaryRays secondaryRays(const Triangles& mesh, const std::vector<Ray>& rays, const std::vector<Hit>& hits, uint32_t perHit,
                            uint32_t seed) {
    const Surroundings around = surroundingsOf(mesh);
    const glm::vec3 light = around.center + around.radius * kTowardsLight;
    SecondaryRays out;
    for (uint32_t pass = 0; pass < perHit; ++pass)
        for (size_t i = 0; i < rays.size(); ++i) {
            if (hits[i].primitive == kNoHit) continue;
            Random random(seed, pass * rays.size() + i);
            const Triangle& v = mesh[hits[i].primitive];
            const glm::vec3 area = glm::cross(v[1] - v[0], v[2] - v[0]);
            const float size = glm::length(area);
            if (!(size > 0)) continue;
            const glm::vec3 normal = area / (glm::dot(area, rays[i].direction) > 0 ? -size : size);
            const glm::vec3 p = rays[i].origin + hits[i].t * rays[i].direction + normal * (kLift * around.radius);
            const glm::vec3 jitter(random.uniform(), random.uniform(), random.uniform());
            const glm::vec3 towards = light + (2.0f * jitter - 1.0f) * (kLightHalfSize * around.radius) - p;
            const float distance = glm::length(towards);
            out.shadow.push_back({p, 0, towards / distance, distance});
            out.diffuse.push_back({p, 0, cosineWeighted(normal, random), kRayEnd});
        }
    return out;
}

std::vector<Ray> shuffled(std::vector<Ray> rays, uint32_t seed) {
    for (size_t i = rays.size(); i > 1; --i) {
        const uint64_t j = uint64_t{randomBits((uint64_t{seed} << 40 | uint64_t{1} << 39) + i)} * i >> 32;
        std::swap(rays[i - 1], rays[j]);
    }
    return rays;
}

}  // namespace bench
