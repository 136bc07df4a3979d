#include "gems.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "polyhedron.hpp"

namespace samples {
namespace {

/// The point at `radius` from the axis, `degrees` around it.
glm::dvec3 polar(double radius, double degrees, double y) {
    return {radius * std::cos(glm::radians(degrees)), y, radius * std::sin(glm::radians(degrees))};
}

/// The facet through `p` that faces `azimuth` and is inclined to the girdle plane; a negative angle faces down.
Plane inclined(const glm::dvec3& p, double azimuthDegrees, double angleDegrees) {
    const double angle = glm::radians(std::abs(angleDegrees));
    const glm::dvec3 normal = polar(std::sin(angle), azimuthDegrees, std::copysign(std::cos(angle), angleDegrees));
    return {normal, glm::dot(normal, p)};
}

/// The plane through the points of which the solid, around the origin, is the inner side.
Plane around(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const Plane plane = planeThrough(a, b, c);
    return plane.distance > 0 ? plane : Plane{-plane.normal, -plane.distance};
}

// Angles: M. Tolkowsky, Diamond Design (1919). Table, star and lower-half lengths: within the best grade of the
// Gemological Institute of America's cut grading for round brilliants.
constexpr double kCrownAngle = 34.5;
constexpr double kPavilionAngle = 40.75;
constexpr double kTable = 0.57;            // corner to corner, of the girdle's diameter
constexpr double kStarLength = 0.5;        // of the way from the table's edge to the girdle, seen from above
constexpr double kLowerHalfLength = 0.77;  // of the way from the girdle to the culet, seen from below
constexpr double kGirdle = 0.035;          // half thickness where it is thickest

void addCrown(std::vector<Plane>& planes) {
    const double slope = std::tan(glm::radians(kCrownAngle));
    const double tableHeight = kGirdle + (1 - kTable) * slope;
    const double toHalf = std::cos(glm::radians(22.5));
    const double starRadius = glm::mix(kTable * toHalf, 1.0, kStarLength);
    const double starHeight = kGirdle + (1 - starRadius * toHalf) * slope;
    planes.push_back({{0, 1, 0}, tableHeight});
    for (double azimuth = 0; azimuth < 360; azimuth += 45) {
        const glm::dvec3 starTip = polar(starRadius, azimuth + 22.5, starHeight);
        const glm::dvec3 nextBezel = polar(1, azimuth + 45, kGirdle);
        const glm::dvec3 between = polar(1, azimuth + 22.5, kGirdle);
        planes.push_back(inclined(polar(1, azimuth, kGirdle), azimuth, kCrownAngle));
        planes.push_back(around(polar(kTable, azimuth, tableHeight), starTip, polar(kTable, azimuth + 45, tableHeight)));
        planes.push_back(around(polar(1, azimuth, kGirdle), starTip, between));
        planes.push_back(around(between, starTip, nextBezel));
    }
}

void addPavilion(std::vector<Plane>& planes) {
    const double slope = std::tan(glm::radians(kPavilionAngle));
    const double meetRadius = 1 - kLowerHalfLength;
    const double meetHeight = -kGirdle - (1 - meetRadius * std::cos(glm::radians(22.5))) * slope;
    for (double azimuth = 0; azimuth < 360; azimuth += 45) {
        const glm::dvec3 meet = polar(meetRadius, azimuth + 22.5, meetHeight);
        const glm::dvec3 between = polar(1, azimuth + 22.5, -kGirdle);
        planes.push_back(inclined(polar(1, azimuth, -kGirdle), azimuth, -kPavilionAngle));
        planes.push_back(around(polar(1, azimuth, -kGirdle), meet, between));
        planes.push_back(around(between, meet, polar(1, azimuth + 45, -kGirdle)));
    }
}

/// A row of step facets: from `inset` inside the girdle outline at height `y`, `angle` to the girdle plane.
struct Step {
    double inset;
    double y;
    double angle;
};

/// Steps of a crown (sign 1) or pavilion (sign -1): each starts where the one before has come in by its share of the width.
std::vector<Step> steps(double sign, double girdle, const std::vector<std::pair<double, double>>& widthsAndAngles) {
    std::vector<Step> rows;
    Step row{0, sign * girdle, 0};
    for (const auto& [width, angle] : widthsAndAngles) {
        row.angle = sign * angle;
        rows.push_back(row);
        row.inset += width;
        row.y += sign * width * std::tan(glm::radians(angle));
    }
    return rows;
}

}  // namespace

Mesh brilliantCut() {
    std::vector<Plane> planes;
    addCrown(planes);
    for (int i = 0; i < kBrilliantGirdleFacets; ++i) {
        const double azimuth = 360.0 * (i + 0.5) / kBrilliantGirdleFacets;
        planes.push_back({polar(1, azimuth, 0), std::cos(glm::pi<double>() / kBrilliantGirdleFacets)});
    }
    addPavilion(planes);
    return convexPolyhedron(planes);
}

Mesh stepCut(double halfLength, double halfWidth) {
    const double w = halfWidth;
    const double girdle = 0.03 * w;
    const std::vector<std::pair<double, double>> crown{{0.14 * w, 46}, {0.13 * w, 38}, {0.12 * w, 29}};
    const std::vector<std::pair<double, double>> pavilion{{0.2 * w, 58}, {0.28 * w, 47}, {0.52 * w, 37}};
    const double corner = (halfLength + halfWidth - 0.45 * w) / glm::root_two<double>();  // bevels 0.45 w off both sides

    std::vector<Step> rows = steps(1, girdle, crown);
    const double tableHeight = rows.back().y + crown.back().first * std::tan(glm::radians(crown.back().second));
    for (const Step& row : steps(-1, girdle, pavilion)) rows.push_back(row);

    std::vector<Plane> planes{{{0, 1, 0}, tableHeight}};
    for (int side = 0; side < 8; ++side) {
        const double azimuth = 45.0 * side;
        const double apothem = side % 2 == 1 ? corner : side % 4 == 0 ? halfLength : halfWidth;
        planes.push_back({polar(1, azimuth, 0), apothem});
        for (const Step& row : rows) planes.push_back(inclined(polar(apothem - row.inset, azimuth, row.y), azimuth, row.angle));
    }
    return convexPolyhedron(planes);
}

}  // namespace samples
