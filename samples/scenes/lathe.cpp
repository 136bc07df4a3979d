#include "lathe.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace samples {
namespace {

glm::dvec2 perpendicular(const glm::dvec2& v) {
    return {-v.y, v.x};
}

/// The arc of `radius` that touches the lines before and after `corner`.
void appendArc(Profile& profile, const glm::dvec2& before, const glm::dvec2& corner, const glm::dvec2& after, double radius) {
    const glm::dvec2 in = glm::normalize(corner - before);
    const glm::dvec2 out = glm::normalize(after - corner);
    const double turn = std::atan2(in.x * out.y - in.y * out.x, glm::dot(in, out));
    const double side = std::copysign(1.0, turn);
    const glm::dvec2 start = corner - in * radius * std::tan(std::abs(turn) / 2);
    const glm::dvec2 centre = start + perpendicular(in) * side * radius;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / glm::radians(10.0))));
    for (int i = 0; i <= steps; ++i) {
        const double angle = turn * i / steps;
        const glm::dvec2 spoke = start - centre;
        profile.push_back(centre + spoke * std::cos(angle) + perpendicular(spoke) * std::sin(angle));
    }
}

/// Indices of the vertices of one profile point: a ring, or the same pole `segments` times over.
std::vector<std::vector<uint32_t>> addRings(Mesh& mesh, const Profile& profile, int segments) {
    std::vector<std::vector<uint32_t>> rings;
    for (size_t j = 0; j < profile.size(); ++j) {
        const bool pole = j == 0 || j + 1 == profile.size();
        const double radius = pole ? 0 : profile[j].x;
        std::vector<uint32_t> ring;
        for (int i = 0; i < segments; ++i) {
            const double azimuth = glm::two_pi<double>() * i / segments;
            if (!pole || i == 0) mesh.positions.push_back({radius * std::cos(azimuth), profile[j].y, radius * std::sin(azimuth)});
            ring.push_back(static_cast<uint32_t>(mesh.positions.size() - 1));
        }
        rings.push_back(ring);
    }
    return rings;
}

/// One row of segments + 1 coordinates a profile point, for the seam.
void addUvs(Mesh& mesh, const Profile& profile, int segments) {
    std::vector<double> length(1, 0.0);
    for (size_t j = 1; j < profile.size(); ++j) length.push_back(length.back() + glm::distance(profile[j - 1], profile[j]));
    for (double along : length) {
        for (int i = 0; i <= segments; ++i) mesh.uvs.push_back({1 - static_cast<double>(i) / segments, along / length.back()});
    }
}

}  // namespace

Profile rounded(const std::vector<ProfileCorner>& corners) {
    Profile profile;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 corner{corners[i].r, corners[i].y};
        if (corners[i].fillet <= 0) {
            profile.push_back(corner);
            continue;
        }
        const ProfileCorner& before = corners[i - 1];
        const ProfileCorner& after = corners[i + 1];
        appendArc(profile, {before.r, before.y}, corner, {after.r, after.y}, corners[i].fillet);
    }
    return profile;
}

Profile spline(const Profile& points, int steps) {
    Profile result;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec2 a = points[i];
        const glm::dvec2 b = points[i + 1];
        const glm::dvec2 tangentA = 0.5 * (b - points[i == 0 ? 0 : i - 1]);
        const glm::dvec2 tangentB = 0.5 * (points[std::min(i + 2, points.size() - 1)] - a);
        for (int s = 0; s < steps; ++s) {
            const double t = static_cast<double>(s) / steps;
            const double t2 = t * t;
            const double t3 = t2 * t;
            result.push_back((2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * tangentA + (3 * t2 - 2 * t3) * b +
                             (t3 - t2) * tangentB);
        }
    }
    result.push_back(points.back());
    return result;
}

Profile subdivided(const Profile& profile, double longest) {
    Profile result(1, profile.front());
    for (size_t i = 1; i < profile.size(); ++i) {
        const int pieces = std::max(1, static_cast<int>(std::ceil(glm::distance(profile[i - 1], profile[i]) / longest)));
        for (int p = 1; p <= pieces; ++p) {
            result.push_back(glm::mix(profile[i - 1], profile[i], static_cast<double>(p) / pieces));
        }
    }
    return result;
}

Mesh lathe(const Profile& profile, int segments) {
    Mesh mesh;
    const std::vector<std::vector<uint32_t>> rings = addRings(mesh, profile, segments);
    addUvs(mesh, profile, segments);
    const auto corner = [&](size_t j, int i) {
        const uint32_t uv = static_cast<uint32_t>(j) * static_cast<uint32_t>(segments + 1) + static_cast<uint32_t>(i);
        return Corner{rings[j][static_cast<size_t>(i % segments)], kNone, uv};
    };
    for (size_t j = 0; j + 1 < profile.size(); ++j) {
        for (int i = 0; i < segments; ++i) {
            Face face{corner(j, i), corner(j + 1, i), corner(j + 1, i + 1), corner(j, i + 1)};
            if (j == 0) face.erase(face.begin() + 3);
            if (j + 2 == profile.size()) face.erase(face.begin() + 2);
            mesh.faces.push_back(face);
        }
    }
    return mesh;
}

}  // namespace samples
