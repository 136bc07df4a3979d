#include "path_scene.hpp"

#include <algorithm>
#include <cmath>

using glm::dvec3;

namespace test {
namespace {

/// Squares of `side` pixels become one, with their mean.
Picture shrink(const Picture& fine, uint32_t side) {
    Picture picture;
    picture.width = fine.width / side, picture.height = fine.height / side;
    picture.rgba.resize(size_t{picture.width} * picture.height * 4);
    const float share = 1.0f / static_cast<float>(side * side);
    for (uint32_t y = 0; y < fine.height; ++y)
        for (uint32_t x = 0; x < fine.width; ++x)
            for (uint32_t k = 0; k < 4; ++k)
                picture.rgba[(size_t{y / side} * picture.width + x / side) * 4 + k] +=
                    share * fine.rgba[(size_t{y} * fine.width + x) * 4 + k];
    return picture;
}

}  // namespace

std::string pathStart(const View& view, const std::string& render) {
    std::string text = view.text();
    const std::string key = quoted("render") + "{";
    return "{" + text.insert(text.find(key) + key.size(), R"("integrator":"path",)" + render) + ",";
}

std::string pathScene(const View& view, const std::string& rest) {
    return pathStart(view) + rest + "}";
}

std::string background(double radiance) {
    return R"("background":{"color":)" + json(dvec3(radiance)) + "}";
}

std::string pbr(const std::string& members) {
    return R"({"model":"pbr",)" + members + "}";
}

std::string lambert(const dvec3& color) {
    return pbr(R"("ior":1,"baseColor":)" + json(color));
}

std::string rectangleLight(const dvec3& origin, const dvec3& u, const dvec3& v, const dvec3& radiance) {
    return R"({"type":"rectangle","origin":)" + json(origin) + R"(,"u":)" + json(u) + R"(,"v":)" + json(v) + R"(,"radiance":)" +
           json(radiance) + "}";
}

std::string sphereLight(const dvec3& center, double radius, const dvec3& radiance) {
    return R"({"type":"sphere","center":)" + json(center) + R"(,"radius":)" + json(radius) + R"(,"radiance":)" + json(radiance) +
           "}";
}

std::string only(const std::string& material, const std::string& objects) {
    return R"("materials":{"m":)" + material + R"(},"objects":[)" + objects + "]";
}

Picture renderPath(const LoadedScene& scene, uint32_t samples, uint32_t strategy, uint32_t seed) {
    minirt_scene_desc defaults;
    minirt_get_scene_desc(scene.get(), &defaults);
    uint32_t side = 1;
    while (4 * side * side <= samples && 4 * side * side * defaults.width * defaults.height <= 65536) side *= 2;
    minirt_render_desc desc = {};
    desc.width = side * defaults.width, desc.height = side * defaults.height;
    desc.samples = samples / (side * side);
    desc.light_sampling = strategy;
    desc.seed = seed;
    return shrink(scene.render(desc), side);
}

dvec3 meanOf(const Picture& picture) {
    dvec3 sum(0);
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x) sum += dvec3(picture.at(x, y));
    return sum / (double{1} * picture.width * picture.height);
}

Estimate estimate(const LoadedScene& scene, uint32_t samples, uint32_t strategy, const std::function<dvec3(const Picture&)>& of) {
    constexpr int kSeeds = 16;
    dvec3 sum(0), squares(0);
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        const dvec3 mean = of(renderPath(scene, samples, strategy, seed));
        sum += mean, squares += mean * mean;
    }
    const dvec3 variance = glm::max(squares / double{kSeeds} - sum * sum / double{kSeeds * kSeeds}, dvec3(0));
    return {sum / double{kSeeds}, glm::sqrt(variance / double{kSeeds - 1})};
}

}  // namespace test
