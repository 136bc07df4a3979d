// The effects that a scene calls for. A kernel holds only those; everything else is gone from its code, buffers and bindings.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry.hpp"
#include "scene.hpp"
#include "volumes.hpp"

namespace minirtc {

enum class Effect {
    triangles,
    spheres,
    smoothNormals,
    textures,
    checker,
    pointLights,
    directionalLights,
    spotLights,
    areaLights,
    environmentLight,
    highlights,
    reflection,
    refraction,
    fresnel,
    microfacets,
    roughTransmission,
    normalMaps,
    surfaceMaps,
    emission,
    emissionMaps,
    alpha,
    backgroundImage,
    thin,
    nesting,
    parity,
    selfOverlap,
    absorption,
    inscatter,
    dispersion,
    spectral,
    transmissiveShadows,
    lens,
    floatNodes,
    count
};

constexpr size_t kEffectCount = static_cast<size_t>(Effect::count);

struct EffectInfo {
    const char* name;    // on the command line and in `inspect`
    const char* define;  // switches the effect's shader file to its real version
    const char* absent;  // why it is out when nothing calls for it
};

const EffectInfo& effectInfo(Effect effect);

/// In or out, and why: the object, material or light that called for it.
struct EffectChoice {
    bool included = false;
    std::string reason;
};

struct EffectSet {
    std::array<EffectChoice, kEffectCount> choices;
    uint32_t volumeCapacity = 1;  // entries of a ray's list of volumes, where nesting is in
    bool profile = false;         // traversal counts what it does: of kernels that minirt-bench compiles alone
    LeverSettings levers;         // that are not at their default: the kernels go by them (levers.hpp)
    bool has(Effect effect) const { return choices[static_cast<size_t>(effect)].included; }
    EffectChoice& operator[](Effect effect) { return choices[static_cast<size_t>(effect)]; }
    const EffectChoice& operator[](Effect effect) const { return choices[static_cast<size_t>(effect)]; }
    /// True when a hit can send on two rays, so that one must wait.
    bool splits() const { return has(Effect::refraction); }
    /// How many rays one ray can become where media disperse.
    uint32_t channels() const { return !has(Effect::dispersion) ? 1 : has(Effect::spectral) ? 4 : 3; }
};

/// Decides each effect from the scene: the materials that objects use, the lights, the background, the geometry, the volumes. `paths`: for the path
/// tracers too; else for Whitted's tracer alone.
EffectSet analyseEffects(const Scene& scene, const Geometry& geometry, const Volumes& volumes, bool floatNodes, bool paths);

/// Every effect, whether called for or not.
void includeAll(EffectSet& effects);

/// The effect of that name. Throws Error, which names the nearest one.
Effect findEffect(const std::string& name);

/// Leaves an effect out. Throws Error where the scene calls for it, unless `force`, and where it is a layout that the blob has.
void removeEffect(EffectSet& effects, Effect effect, bool force);

}  // namespace minirtc
