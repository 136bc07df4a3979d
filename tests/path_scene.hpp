// Scenes for the path tracers as text, and their pictures.
#pragma once
#include "scene_text.hpp"

namespace test {

constexpr double kPi = 3.14159265358979323846;

/// A scene up to the members that follow "camera" and "render": an open brace and a comma at the end. `render`: further keys of "render".
std::string pathStart(const View& view, const std::string& render = "");
/// `rest`: the other members of the scene.
std::string pathScene(const View& view, const std::string& rest);

std::string background(double radiance);

std::string pbr(const std::string& members);
std::string lambert(const glm::dvec3& color);

std::string rectangleLight(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& radiance);
std::string sphereLight(const glm::dvec3& center, double radius, const glm::dvec3& radiance);

/// Members "materials", of which there is one, "m", and "objects".
std::string only(const std::string& material, const std::string& objects);

/// `samples` a pixel, by the box filter. Devices do one large picture sooner than many samples of a small one: up to 65536 pixels, each
/// becomes a square of several.
Picture renderPath(const LoadedScene& scene, uint32_t samples, uint32_t strategy = MINIRT_LIGHT_SAMPLING_MIS, uint32_t seed = 0);

glm::dvec3 meanOf(const Picture& picture);

/// Of pictures with seeds of their own: the mean of their means, and how far off it may be (one sigma).
struct Estimate {
    glm::dvec3 mean, sigma;
};

/// Of any kind of number that a picture has.
Estimate estimate(const LoadedScene& scene, uint32_t samples, uint32_t strategy = MINIRT_LIGHT_SAMPLING_MIS,
                  const std::function<glm::dvec3(const Picture&)>& of = meanOf);

}  // namespace test
