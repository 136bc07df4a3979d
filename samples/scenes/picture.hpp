// Pictures that the sample scenes need, and the files they go to.
#pragma once
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace samples {

/// Linear RGB, row 0 at the top.
struct Picture {
    int width;
    int height;
    std::vector<glm::vec3> pixels;
    std::vector<float> alpha;  // empty: opaque
};

/// `colorAt(u, v)` at the centre of every pixel; u to the right, v down, both in [0,1].
Picture paint(int width, int height, const std::function<glm::dvec3(double, double)>& colorAt);

/// Equirectangular evening sky over a lake between hills, lit by three soft boxes; +Y at the top row, -Z at u = 1/4. Linear
/// radiance.
Picture eveningSky(int width, int height);

/// The same lake at noon, without lamps.
Picture noonSky(int width, int height);

/// Equirectangular photographer's studio: dark, soft boxes at the sides, small lamps overhead, a cool backdrop at -Z.
Picture studio(int width, int height);

/// Equirectangular room for pictures of products: grey, with large soft boxes to the left, to the right and overhead.
Picture softBoxes(int width, int height);

/// Equirectangular bar by night, out of focus.
Picture bar(int width, int height);

/// Planks of polished walnut along u.
Picture wood(int width, int height);

/// Coarse light sand; repeats in u and v.
Picture sandGrains(int width, int height);

/// Cobalt bands and petals on white, for the vase: repeats in u, v = 0 at the top.
Picture porcelain(int width, int height);

/// All throw std::runtime_error when the file cannot be written.
void writeHdr(const Picture& picture, const std::filesystem::path& path);
void writePng(const Picture& picture, const std::filesystem::path& path);        // sRGB, clamped
void writeLinearPng(const Picture& picture, const std::filesystem::path& path);  // the numbers as they are, clamped: no colours

}  // namespace samples
