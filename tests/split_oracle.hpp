// A tracer in double of scenes whose faces say themselves which media they part. It knows no list of volumes: a judge of nested ones.
#pragma once
#include <functional>
#include <vector>

#include "oracle.hpp"

namespace test {

struct SplitFace {
    glm::dvec3 a, b, c;
    int front = 0;  // medium on the side of cross(b - a, c - a)
    int back = 0;
};

/// The media in front of a point on a face and behind it. Where they are the same, the face parts nothing there.
struct Sides {
    int front = 0, back = 0;
};

struct SplitMedium {
    double ior = 1;
    glm::dvec3 sigma{0};  // 1/m
};

/// Radiance towards `p` from a square wall z = -6 of 60 m, phong's diffuse 0.5, which a point light of 40 W/sr at z = -4 lights; 0.25 around it.
glm::dvec3 litWall(const glm::dvec3& p, const glm::dvec3& d);

class SplitScene {
public:
    /// `surroundings`: radiance that a ray from a point in a direction finds where it meets no face. `sidesAt`: overrules
    /// what a face says where the media change within it; may be empty. Positions are rounded to float, as in a blob.
    SplitScene(const std::vector<SplitFace>& faces, std::vector<SplitMedium> media,
               std::function<glm::dvec3(const glm::dvec3&, const glm::dvec3&)> surroundings,
               std::function<Sides(const SplitFace&, const glm::dvec3&)> sidesAt = {});

    /// What a camera at `p` in the surrounding medium sees: Whitted's tree down to `maxDepth`, rays under a throughput of 1/512 left out.
    glm::dvec3 radiance(const glm::dvec3& p, const glm::dvec3& d, int maxDepth);

    /// Faces met from a medium that is not theirs: the faces do not fit together there.
    size_t misfits() const { return misfits_; }

private:
    glm::dvec3 follow(glm::dvec3 p, const glm::dvec3& d, const glm::dvec3& throughput, int medium, int depth);

    std::vector<SplitFace> faces_;
    std::vector<SplitMedium> media_;
    std::function<glm::dvec3(const glm::dvec3&, const glm::dvec3&)> surroundings_;
    std::function<Sides(const SplitFace&, const glm::dvec3&)> sidesAt_;
    oracle::DoubleScene scene_;
    double nearest_;  // shorter ways are the surface that the ray leaves
    int maxDepth_ = 0;
    size_t misfits_ = 0;
};

}  // namespace test
