#include "shining.hpp"

namespace minirtc {
namespace {

bool nonZero(const glm::dvec3& v) {
    return v.x > 0 || v.y > 0 || v.z > 0;
}

glm::dvec3 mean(const Image& image) {
    glm::dvec3 sum(0);
    for (const glm::vec4& texel : image.texels) sum += glm::dvec3(texel);
    return sum / static_cast<double>(image.texels.size());
}

}  // namespace

double luminance(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 meanEmission(const Material& material, const Scene& scene) {
    if (material.checker)
        return 0.5 * (meanEmission(scene.materials[material.checkerA], scene) +
                      meanEmission(scene.materials[material.checkerB], scene));
    const glm::dvec3 emission(material.emission);
    if (material.emissionTexture == kNone || !nonZero(emission)) return emission;
    return emission * mean(scene.images[material.emissionTexture]);
}

bool backgroundShines(const Scene& scene) {
    const Background& background = scene.background;
    if (background.image == kNone) return nonZero(background.color);
    const auto& texels = scene.images[background.image].texels;
    return background.strength > 0 &&
           std::any_of(texels.begin(), texels.end(), [](const glm::vec4& t) { return nonZero(glm::dvec3(t)); });
}

bool anythingShines(const Scene& scene) {
    const auto shines = [](const Light& light) { return nonZero(light.intensity); };
    const auto glows = [&](const Material& material) { return nonZero(meanEmission(material, scene)); };
    return std::any_of(scene.lights.begin(), scene.lights.end(), shines) ||
           std::any_of(scene.materials.begin(), scene.materials.end(), glows) || backgroundShines(scene);
}

}  // namespace minirtc
