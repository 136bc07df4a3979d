#include "effects.hpp"

#include <algorithm>
#include <set>

#include "error.hpp"
#include "json_fields.hpp"
#include "shining.hpp"
#include "text_file.hpp"

namespace minirtc {
namespace {

constexpr std::array<EffectInfo, kEffectCount> kEffects = {{
    {"triangles", "EFFECT_TRIANGLES", "every object is a sphere"},
    {"spheres", "EFFECT_SPHERES", "no object is a sphere"},
    {"smooth_normals", "EFFECT_SMOOTH_NORMALS", "every vertex normal equals its face's"},
    {"textures", "EFFECT_TEXTURES", "no material in use has a texture"},
    {"checker", "EFFECT_CHECKER", "no object has a checker material"},
    {"point_lights", "EFFECT_POINT_LIGHTS", "there is no point light"},
    {"directional_lights", "EFFECT_DIRECTIONAL_LIGHTS", "there is no directional light"},
    {"spot_lights", "EFFECT_SPOT_LIGHTS", "there is no spot light"},
    {"area_lights", "EFFECT_AREA_LIGHTS", "no surface shines for path tracers to pick"},
    {"environment_light", "EFFECT_ENVIRONMENT_LIGHT", "no background shines for path tracers to pick"},
    {"highlights", "EFFECT_HIGHLIGHTS", "no lit material in use has a highlight"},
    {"reflection", "EFFECT_REFLECTION", "no material in use reflects"},
    {"refraction", "EFFECT_REFRACTION", "no material in use transmits"},
    {"fresnel", "EFFECT_FRESNEL", "no material in use splits by Fresnel"},
    {"microfacets", "EFFECT_MICROFACETS", "path tracers meet no metal and no coat"},
    {"rough_transmission", "EFFECT_ROUGH_TRANSMISSION", "path tracers meet no rough glass"},
    {"normal_maps", "EFFECT_NORMAL_MAPS", "no material in use has a normal map"},
    {"surface_maps", "EFFECT_SURFACE_MAPS", "no material in use has a texture of roughness and metallic"},
    {"emission", "EFFECT_EMISSION", "no material in use shines"},
    {"emission_maps", "EFFECT_EMISSION_MAPS", "no material in use has a texture of emission"},
    {"alpha", "EFFECT_ALPHA", "no material in use has holes"},
    {"background_image", "EFFECT_BACKGROUND_IMAGE", "the background is a constant"},
    {"thin", "EFFECT_THIN", "no material in use is thin-walled"},
    {"nesting", "EFFECT_NESTING", "no ray needs to know which volumes it is in"},
    {"parity", "EFFECT_PARITY", "volumes nest by their order, or not at all"},
    {"self_overlap", "EFFECT_SELF_OVERLAP", "no volume overlaps itself"},
    {"absorption", "EFFECT_ABSORPTION", "every medium is clear"},
    {"inscatter", "EFFECT_INSCATTER", "no medium has a colour of its own"},
    {"dispersion", "EFFECT_DISPERSION", "no medium disperses light"},
    {"spectral", "EFFECT_SPECTRAL", "light disperses as red, green and blue, or not at all"},
    {"transmissive_shadows", "EFFECT_TRANSMISSIVE_SHADOWS", "no light meets what transmits, or shadows are opaque"},
    {"lens", "EFFECT_LENS", "the camera is a pinhole, or nothing traces paths"},
    {"float_nodes", "EFFECT_FLOAT_NODES", "16-bit boxes fit this scene"},
}};

bool nonZero(const glm::vec3& v) {
    return v.x > 0 || v.y > 0 || v.z > 0;
}

void callFor(EffectSet& effects, Effect effect, bool wanted, const std::string& reason) {
    EffectChoice& choice = effects[effect];
    if (!wanted || choice.included) return;
    choice.included = true;
    choice.reason = reason;
}

/// True where alpha lets light through somewhere.
bool hasHoles(const Material& material, const Scene& scene) {
    if (material.alphaMode == AlphaMode::opaque) return false;
    float least = 1;
    if (material.diffuseTexture != kNone)
        for (const glm::vec4& texel : scene.images[material.diffuseTexture].texels) least = std::min(least, texel.a);
    return material.alpha * least < (material.alphaMode == AlphaMode::mask ? material.alphaCutoff : 1.0f);
}

/// What only a pbr material has. One of index 1 without metal and transmission is matte.
void addPhysical(EffectSet& effects, const Material& material, bool paths, const std::string& reason) {
    const Physical& physical = *material.physical;
    const bool opaquePart = physical.transmission < 1 && (physical.metallic > 0 || material.ior != 1);
    callFor(effects, Effect::microfacets, paths && opaquePart, reason);
    callFor(effects, Effect::roughTransmission, paths && physical.transmission > 0 && physical.roughness > 0, reason);
    callFor(effects, Effect::normalMaps, material.normalTexture != kNone && material.normalScale != 0, reason);
    callFor(effects, Effect::surfaceMaps, paths && material.surfaceTexture != kNone, reason);
}

void addMaterial(EffectSet& effects, const Scene& scene, uint32_t index, bool paths, const std::string& object) {
    const Material& material = scene.materials[index];
    const std::string reason = "material '" + material.name + "' of " + object;
    if (material.checker) {
        callFor(effects, Effect::checker, true, reason);
        addMaterial(effects, scene, material.checkerA, paths, object);
        addMaterial(effects, scene, material.checkerB, paths, object);
        return;
    }
    const bool lit = !scene.lights.empty();
    const bool colored = nonZero(material.diffuse) || (paths && material.physical && nonZero(material.physical->baseColor));
    callFor(effects, Effect::textures, (lit || paths) && material.diffuseTexture != kNone && colored, reason);
    callFor(effects, Effect::highlights, lit && nonZero(material.specular), reason);
    callFor(effects, Effect::reflection, nonZero(material.reflect), reason);
    callFor(effects, Effect::refraction, nonZero(material.transmit), reason);
    callFor(effects, Effect::fresnel, material.fresnel && (nonZero(material.reflect) || nonZero(material.transmit)), reason);
    callFor(effects, Effect::emission, nonZero(material.emission), reason);
    const bool transmits = nonZero(material.transmit);
    callFor(effects, Effect::thin, transmits && material.thin, reason);
    callFor(effects, Effect::absorption, boundsVolume(material) && nonZero(material.medium.absorption), reason);
    const bool glows = nonZero(material.medium.absorption) && material.medium.inscatter > 0;
    callFor(effects, Effect::inscatter, boundsVolume(material) && glows, reason);
    const bool disperses = boundsVolume(material) && material.medium.dispersion;
    callFor(effects, Effect::dispersion, disperses, reason);
    callFor(effects, Effect::spectral, disperses && scene.render.dispersionMode == DispersionMode::spectral,
            "\"dispersionMode\": \"spectral\"");
    callFor(effects, Effect::transmissiveShadows, (lit || paths) && transmits && material.clearShadows, reason);
    callFor(effects, Effect::emissionMaps, nonZero(material.emission) && material.emissionTexture != kNone, reason);
    callFor(effects, Effect::alpha, hasHoles(material, scene), reason);
    if (material.physical) addPhysical(effects, material, paths, reason);
}

void addLights(EffectSet& effects, const Scene& scene, bool paths) {
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const LightType type = scene.lights[i].type;
        callFor(effects,
                type == LightType::point  ? Effect::pointLights
                : type == LightType::spot ? Effect::spotLights
                                          : Effect::directionalLights,
                true, "light " + std::to_string(i));
    }
    const bool image = scene.background.image != kNone;
    const std::string name = image ? "background '" + scene.images[scene.background.image].name + "'" : "background";
    callFor(effects, Effect::backgroundImage, image, name);
    callFor(effects, Effect::environmentLight, paths && backgroundShines(scene), name);
    callFor(effects, Effect::lens, paths && scene.camera.aperture > 0, "the camera's aperture");
}

/// A list of the volumes that a ray is in is needed where volumes share space, or where what is in a volume must know of its medium.
void addVolumes(EffectSet& effects, const Scene& scene, const Volumes& volumes) {
    const bool mediumMatters = effects.has(Effect::absorption) || effects.has(Effect::fresnel);
    callFor(effects, Effect::nesting, !volumes.overlap.empty(), volumes.overlap);
    callFor(effects, Effect::nesting, !volumes.content.empty() && mediumMatters, volumes.content);
    callFor(effects, Effect::nesting, !volumes.selfOverlap.empty(), volumes.selfOverlap);
    const bool nests = effects.has(Effect::nesting);
    callFor(effects, Effect::selfOverlap, nests && !volumes.selfOverlap.empty(), volumes.selfOverlap);
    const bool hides = !volumes.overlap.empty() || !volumes.selfOverlap.empty();
    callFor(effects, Effect::transmissiveShadows, hides && !volumes.lightInside.empty(), volumes.lightInside);
    callFor(effects, Effect::parity, nests && scene.nesting == Nesting::parity, "\"nesting\": \"parity\"");
    // One to spare: a ray that rounding leads past a surface keeps an entry of a volume that it has left.
    effects.volumeCapacity = std::min(std::max(volumes.capacity, 1u) + 1, kMostNested);
}

}  // namespace

const EffectInfo& effectInfo(Effect effect) {
    return kEffects[static_cast<size_t>(effect)];
}

EffectSet analyseEffects(const Scene& scene, const Geometry& geometry, const Volumes& volumes, bool floatNodes, bool paths) {
    EffectSet effects;
    for (size_t i = 0; i < kEffectCount; ++i) effects.choices[i].reason = kEffects[i].absent;
    std::set<uint32_t> seen;
    for (const Primitive& primitive : geometry.primitives) {
        const std::string& object = geometry.bodies[primitive.body].name;
        callFor(effects, Effect::triangles, !primitive.isSphere, object);
        callFor(effects, Effect::spheres, primitive.isSphere, object);
        if (!seen.insert(primitive.material).second) continue;
        addMaterial(effects, scene, primitive.material, paths, object);
        const Material& material = scene.materials[primitive.material];
        callFor(effects, Effect::areaLights, paths && nonZero(glm::vec3(meanEmission(material, scene))),
                "material '" + material.name + "' of " + object);
    }
    callFor(effects, Effect::smoothNormals, geometry.anySmooth, "vertex normals that differ from their face's");
    addLights(effects, scene, paths);
    addVolumes(effects, scene, volumes);
    callFor(effects, Effect::floatNodes, floatNodes, "16-bit boxes would lose too much on this scene");
    return effects;
}

void includeAll(EffectSet& effects) {
    for (size_t i = 0; i < kEffectCount; ++i) {
        // A layout or a method, not a cost that a scene could avoid.
        const auto effect = static_cast<Effect>(i);
        if (effect == Effect::floatNodes || effect == Effect::parity || effect == Effect::selfOverlap ||
            effect == Effect::spectral)
            continue;
        callFor(effects, static_cast<Effect>(i), true, "asked for by --all-effects");
    }
}

Effect findEffect(const std::string& name) {
    std::vector<std::string> names;
    for (size_t i = 0; i < kEffectCount; ++i) {
        if (kEffects[i].name == name) return static_cast<Effect>(i);
        names.emplace_back(kEffects[i].name);
    }
    throw Error("there is no effect " + inQuotes(name), suggest(name, names));
}

void removeEffect(EffectSet& effects, Effect effect, bool force) {
    const std::string name = effectInfo(effect).name;
    EffectChoice& choice = effects[effect];
    if (effect == Effect::floatNodes && choice.included)
        throw Error("the effect 'float_nodes' is the layout of the hierarchy", "choose it with --layout");
    if (choice.included && !force)
        throw Error("the effect '" + name + "' is called for by " + choice.reason,
                    "the picture would be another one without it; leave it out all the same with --force");
    choice = {false, "left out by --without"};
}

}  // namespace minirtc
