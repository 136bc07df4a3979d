#include "light_table.hpp"

#include <cfloat>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "pick_rows.hpp"
#include "shining.hpp"

namespace minirtc {
namespace {

constexpr double kPi = glm::pi<double>();

double areaOf(const Primitive& primitive) {
    if (primitive.isSphere) return 4 * kPi * double{primitive.p[1].x} * primitive.p[1].x;
    const glm::dvec3 a(primitive.p[0]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(primitive.p[1]) - a, glm::dvec3(primitive.p[2]) - a));
}

/// Radiant exitance in W/m^2 of surfaces of this material, by luminance. A checker's is the mean of its two materials'.
double exitance(const Material& material, const Scene& scene) {
    if (material.checker)
        return 0.5 * (exitance(scene.materials[material.checkerA], scene) + exitance(scene.materials[material.checkerB], scene));
    return kPi * luminance(meanEmission(material, scene)) * (material.doubleSided ? 2 : 1);
}

/// W of a light without size. What does not weaken over distance counts as if it shone on the whole scene from its rim.
double powerOf(const Light& light, double sceneRadius) {
    const double intensity = luminance(glm::dvec3(light.intensity));
    const double crossSection = kPi * sceneRadius * sceneRadius;
    if (light.type == LightType::directional) return crossSection * intensity;
    const double reach = light.inverseSquare ? 1 : sceneRadius * sceneRadius;
    if (light.type == LightType::point) return 4 * kPi * intensity * reach;
    // Between the cones the intensity falls by the square of a ramp in the cosine, whose mean is a third.
    const auto [inner, outer] = spotCosines(light);
    return 2 * kPi * ((1 - double{inner}) + (double{inner} - outer) / 3) * intensity * reach;
}

struct Weights {
    std::vector<uint32_t> entries;
    std::vector<double> weights;
    double total = 0;

    void add(uint32_t entry, double weight) {
        if (!(weight > 0)) return;
        entries.push_back(entry);
        weights.push_back(weight);
        total += weight;
    }
};

Weights weigh(const Scene& scene, const Geometry& geometry, const Bvh& bvh, const std::vector<double>& exitances,
              double environment) {
    Weights all;
    const double radius = 0.5 * glm::length(glm::dvec3(geometry.boundsMax) - glm::dvec3(geometry.boundsMin));
    std::vector<bool> isIn(geometry.primitives.size());  // one that was split lies in several slots
    for (uint32_t slot = 0; slot < bvh.order.size(); ++slot) {
        if (isIn[bvh.order[slot]]) continue;
        isIn[bvh.order[slot]] = true;
        const Primitive& primitive = geometry.primitives[bvh.order[slot]];
        all.add(MINIRT_EMITTER_PRIMITIVE | slot, exitances[primitive.material] * areaOf(primitive));
    }
    for (uint32_t i = 0; i < scene.lights.size(); ++i) all.add(MINIRT_EMITTER_LIGHT | i, powerOf(scene.lights[i], radius));
    all.add(MINIRT_EMITTER_ENVIRONMENT, kPi * radius * radius * environment);
    return all;
}

float densityOf(double exitance, double total) {
    return exitance > 0 ? static_cast<float>(std::clamp(exitance / total, double{FLT_MIN}, double{FLT_MAX})) : 0.0f;
}

}  // namespace

LightTable lightTable(const Scene& scene, const Geometry& geometry, const Bvh& bvh, const EnvironmentCells& environment) {
    std::vector<double> exitances;
    for (const Material& material : scene.materials) exitances.push_back(exitance(material, scene));
    Weights all = weigh(scene, geometry, bvh, exitances, environment.total);
    const bool dark = all.weights.empty();
    if (dark) all.add(MINIRT_EMITTER_ENVIRONMENT, 1);

    LightTable table;
    table.emitters = pickRows(all.entries, all.weights);
    for (const double one : exitances) table.densities.push_back(densityOf(one, all.total));
    // Who hits a checker sees the material of a cell; picked are points of the whole.
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (material.checker && exitances[i] > 0)
            table.densities[material.checkerA] = table.densities[material.checkerB] = table.densities[i];
    }
    if (all.entries.back() == MINIRT_EMITTER_ENVIRONMENT) table.environment = probabilityOf(all.weights.back() / all.total);
    return table;
}

}  // namespace minirtc
