// Flat meshes that stand across a view, in any attitude and anywhere.
#pragma once
#include "stage.hpp"

namespace hard_cases {

/// A place with three axes at right angles; walls are in its xy plane and views look along -z.
struct Pose {
    dvec3 center{0};
    dvec3 right{1, 0, 0};
    dvec3 up{0, 1, 0};
    dvec3 back{0, 0, 1};

    dvec3 point(double x, double y, double z = 0) const { return center + x * right + y * up + z * back; }
};

/// Axes that are parallel to no axis of the scene, nor nearly so.
Pose tilted(const dvec3& center);

/// A view of `width` metres of the pose's xy plane from `distance` before it.
View across(const Pose& pose, double distance, double width, uint32_t size);

/// An OBJ grid of `columns` x `rows` cells of the given size, two triangles each, whose middle is (x, y) from the pose's centre.
struct Grid {
    int columns = 1, rows = 1;
    double width = 1, height = 1;  // of a cell
    double x = 0, y = 0;
};
std::string wall(const Pose& pose, const Grid& grid);

/// The length of a ray from the camera within a ball around 0; 0 where it misses.
double chordOf(const View& view, uint32_t x, uint32_t y, double radius);

/// A mesh object.
Json meshOf(const std::string& file, const std::string& material);
/// The parallelogram between two edges from a corner.
Json rectangle(const dvec3& origin, const dvec3& u, const dvec3& v, const std::string& material);
/// Keeps the middle of the scene, from which coordinates count, at zero.
Json counterweight(const Pose& pose, const std::string& material);

}  // namespace hard_cases
