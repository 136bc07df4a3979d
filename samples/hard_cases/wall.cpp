#include "wall.hpp"

#include <cmath>
#include <cstdio>

namespace hard_cases {

Pose tilted(const dvec3& center) {
    Pose pose;
    pose.center = center;
    pose.back = glm::normalize(dvec3(0.36, 0.48, 0.8) + dvec3(0.013, -0.027, 0.041));
    pose.right = glm::normalize(glm::cross(dvec3(0.11, 0.93, -0.2), pose.back));
    pose.up = glm::cross(pose.back, pose.right);
    return pose;
}

View across(const Pose& pose, double distance, double width, uint32_t size) {
    return {pose.point(0, 0, distance), pose.center, glm::degrees(2 * std::atan(width / 2 / distance)), size, pose.up};
}

std::string wall(const Pose& pose, const Grid& grid) {
    std::string text;
    char line[128];
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i) {
            const dvec3 p =
                pose.point(grid.x + (i - 0.5 * grid.columns) * grid.width, grid.y + (j - 0.5 * grid.rows) * grid.height);
            std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
            text += line;
        }
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const int a = j * (grid.columns + 1) + i + 1;
            const int b = a + grid.columns + 1;
            std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", a, a + 1, b + 1, a, b + 1, b);
            text += line;
        }
    return text;
}

double chordOf(const View& view, uint32_t x, uint32_t y, double radius) {
    const dvec3 d = view.direction(x, y);
    const double nearest = glm::length(view.position - glm::dot(view.position, d) * d);
    return nearest < radius ? 2 * std::sqrt(radius * radius - nearest * nearest) : 0;
}

Json meshOf(const std::string& file, const std::string& material) {
    return {{"mesh", file}, {"material", material}};
}

Json rectangle(const dvec3& origin, const dvec3& u, const dvec3& v, const std::string& material) {
    return {{"rectangle", {{"origin", at(origin)}, {"u", at(u)}, {"v", at(v)}}}, {"material", material}};
}

Json counterweight(const Pose& pose, const std::string& material) {
    const double size = 1e-4 * glm::length(pose.center) + 1e-3;
    return rectangle(-pose.center, {size, 0, 0}, {0, size, 0}, material);
}

}  // namespace hard_cases
