// Scenes as text, and the judgement of their pictures by closed forms.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "render_scene.hpp"

namespace test {

std::string json(double number);
std::string json(const glm::dvec3& v);
/// "key": with its quotes.
std::string quoted(const std::string& key);

/// A pinhole camera, as text for the scene and as rays for the closed form.
struct View {
    glm::dvec3 position{0, 0, 5};
    glm::dvec3 target{0};
    double vfov = 40;
    uint32_t size = 48;
    glm::dvec3 up{0, 1, 0};
    uint32_t maxDepth = 20;
    uint32_t samples = 1;

    /// The members "camera" and "render" of a scene.
    std::string text() const;
    /// Unit direction through the centre of a pixel.
    glm::dvec3 direction(uint32_t x, uint32_t y) const;
};

// Objects.
std::string rectangle(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, const std::string& material);
std::string sphere(const glm::dvec3& center, double radius, const std::string& material);
/// The plane y = 0 out to 20 metres, its front upwards.
std::string floorOf(const std::string& material);
/// A closed box; its mesh `name`.obj goes into `dir`.
std::string box(const TemporaryDir& dir, const std::string& name, const glm::dvec3& lo, const glm::dvec3& hi,
                const std::string& material);

// Materials and lights.
std::string glow(double radiance);
std::string glass(double ior);
std::string pointLight(const glm::dvec3& position, const glm::dvec3& intensity, const std::string& falloff);

/// Renders with another limit than the scene's.
minirt_render_desc depthLimit(uint32_t maxDepth);

/// Compares every pixel for which `expected` has a value; the error is relative to it, or to `least` where it is smaller.
void checkPixels(const Picture& picture, double tolerance,
                 const std::function<std::optional<glm::dvec3>(uint32_t, uint32_t)>& expected, double least = 1e-3);

/// Unpolarised Fresnel reflectance at an interface; `eta` is the index behind over the one in front.
double fresnel(double cosI, double eta);

}  // namespace test
