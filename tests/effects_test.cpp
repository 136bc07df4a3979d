#include "effects.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>

#include "glsl.hpp"
#include "kernel.hpp"
#include "minirt.h"

using namespace minirtc;

namespace {

/// A scene of one triangle of object 'thing' with one material, 'paint'; no lights, a constant background; for Whitted's kernel.
struct Small {
    Scene scene;
    Geometry geometry;
    Volumes volumes;
    bool floatNodes = false;

    Small() {
        scene.materials.resize(1);
        scene.materials[0].name = "paint";
        scene.render.integrators = {Integrator::whitted};
        Primitive triangle;
        triangle.p = {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
        geometry.primitives = {triangle};
        geometry.bodies = {{"thing", {}}};
    }

    Material& paint() { return scene.materials[0]; }
    Physical& physical() { return paint().physical.emplace(); }
    Small& paths() {
        scene.render.integrators = {Integrator::whitted, Integrator::path};
        return *this;
    }
    Small& light(LightType type) {
        Light light;
        light.type = type;
        scene.lights.push_back(light);
        return *this;
    }
    uint32_t image(const std::string& name, const glm::vec4& texel = glm::vec4(1)) {
        Image image;
        image.name = name;
        image.width = image.height = 1;
        image.texels = {texel};
        scene.images.push_back(image);
        return static_cast<uint32_t>(scene.images.size() - 1);
    }
    EffectSet effects() const { return analyseEffects(scene, geometry, volumes, floatNodes, scene.render.tracesPaths()); }
};

std::string reason(const EffectSet& effects, Effect effect) {
    return effects[effect].reason;
}

/// The names of the effects that are in, with a blank behind each; but for triangles, which nearly every scene here holds.
std::string included(const EffectSet& effects) {
    std::string names;
    for (size_t i = 0; i < kEffectCount; ++i) {
        if (effects.choices[i].included && static_cast<Effect>(i) != Effect::triangles)
            names += std::string(effectInfo(static_cast<Effect>(i)).name) + " ";
    }
    return names;
}

EffectSet only(std::initializer_list<Effect> wanted) {
    EffectSet effects;
    for (const Effect effect : wanted) effects[effect].included = true;
    return effects;
}

int bindingCount(uint32_t bindings) {
    int count = 0;
    for (; bindings; bindings &= bindings - 1) ++count;
    return count;
}

/// A kernel with some effects.
struct Choice {
    std::string kernel;
    EffectSet effects;
};

/// Whether a kernel's source speaks of an effect.
bool reads(const std::string& kernel, Effect effect) {
    const std::string source = composeKernel(kernel, EffectSet());
    const std::string define = effectInfo(effect).define;
    for (size_t at = source.find(define); at != std::string::npos; at = source.find(define, at + 1)) {
        const char next = source[at + define.size()];
        if (std::isalnum(static_cast<unsigned char>(next)) == 0 && next != '_') return true;
    }
    return false;
}

std::vector<Effect> effectsOf(const std::string& kernel) {
    std::vector<Effect> effects;
    for (size_t i = 0; i < kEffectCount; ++i)
        if (reads(kernel, static_cast<Effect>(i))) effects.push_back(static_cast<Effect>(i));
    return effects;
}

void parseKernel(const std::string& kernel, const EffectSet& effects) {
    const test::ParsedGlsl glsl = test::parseGlsl(composeKernel(kernel, effects));
    if (!glsl.parsed) throw std::runtime_error(glsl.shader->getInfoLog());
}

void compileWhole(const std::string& kernel, const EffectSet& effects) {
    compileKernel(kernel, effects);
}

/// Has every choice compiled on all cores; the log of the first failure, or "".
std::string compileAll(const std::vector<Choice>& choices, void (*compile)(const std::string&, const EffectSet&)) {
    std::atomic<size_t> next{0};
    std::vector<std::string> failures(choices.size());
    const auto work = [&] {
        for (size_t i = next++; i < choices.size(); i = next++) {
            try {
                compile(choices[i].kernel, choices[i].effects);
            } catch (const std::exception& e) {
                failures[i] = choices[i].kernel + ", " + included(choices[i].effects) + ": " + e.what();
            }
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    const auto failed = std::find_if(failures.begin(), failures.end(), [](const std::string& s) { return !s.empty(); });
    return failed == failures.end() ? "" : *failed;
}

/// The kernels of all integrators.
std::vector<std::string> allKernels() {
    EffectSet all;
    includeAll(all);
    std::vector<std::string> names;
    for (const Integrator integrator : {Integrator::whitted, Integrator::path, Integrator::wavefront})
        for (const std::string& name : kernelsOf(integrator, all)) names.push_back(name);
    return names;
}

}  // namespace

TEST_CASE("a scene that calls for nothing has no effect and says why") {
    const EffectSet effects = Small().effects();
    CHECK(included(effects).empty());
    CHECK(effects.has(Effect::triangles));
    CHECK(reason(effects, Effect::triangles) == "thing");
    for (size_t i = 1; i < kEffectCount; ++i) CHECK(effects.choices[i].reason == effectInfo(static_cast<Effect>(i)).absent);
}

TEST_CASE("each property of a material calls for its effect and names material and object") {
    const std::string because = "material 'paint' of thing";
    const glm::vec3 some(0.1f, 0, 0);
    SUBCASE("reflection") {
        Small small;
        small.paint().reflect = some;
        CHECK(included(small.effects()) == "reflection ");
        CHECK(reason(small.effects(), Effect::reflection) == because);
    }
    SUBCASE("refraction") {
        Small small;
        small.paint().transmit = some;
        CHECK(included(small.effects()) == "refraction ");
        CHECK(reason(small.effects(), Effect::refraction) == because);
        CHECK(small.effects().splits());
    }
    SUBCASE("Fresnel, with something to split only") {
        Small small;
        small.paint().fresnel = true;
        CHECK(included(small.effects()).empty());
        small.paint().transmit = some;
        CHECK(included(small.effects()) == "refraction fresnel ");
        CHECK(reason(small.effects(), Effect::fresnel) == because);
    }
    SUBCASE("emission") {
        Small small;
        small.paint().emission = some;
        CHECK(included(small.effects()) == "emission ");
        CHECK(reason(small.effects(), Effect::emission) == because);
    }
    SUBCASE("highlights, where there is light only") {
        Small small;
        small.paint().specular = some;
        CHECK(included(small.effects()).empty());
        CHECK(included(small.light(LightType::point).effects()) == "point_lights highlights ");
        CHECK(reason(small.effects(), Effect::highlights) == because);
    }
    SUBCASE("textures, on lit diffuse surfaces only") {
        Small small;
        small.paint().diffuseTexture = small.image("wood.png");
        small.paint().diffuse = some;
        CHECK(included(small.effects()).empty());
        small.light(LightType::directional);
        CHECK(included(small.effects()) == "textures directional_lights ");
        CHECK(reason(small.effects(), Effect::textures) == because);
        small.paint().diffuse = glm::vec3(0);
        CHECK(included(small.effects()) == "directional_lights ");
    }
}

TEST_CASE("a checker calls for itself and for what its two materials call for") {
    Small small;
    small.scene.materials.resize(3);
    small.scene.materials[1].name = "mirror";
    small.scene.materials[1].reflect = glm::vec3(1);
    small.scene.materials[2].name = "lamp";
    small.scene.materials[2].emission = glm::vec3(1);
    small.paint().checker = true;
    small.paint().checkerA = 1;
    small.paint().checkerB = 2;
    const EffectSet effects = small.effects();
    CHECK(included(effects) == "checker reflection emission ");
    CHECK(reason(effects, Effect::checker) == "material 'paint' of thing");
    CHECK(reason(effects, Effect::reflection) == "material 'mirror' of thing");
    CHECK(reason(effects, Effect::emission) == "material 'lamp' of thing");
}

TEST_CASE("materials that no object uses call for nothing") {
    Small small;
    small.scene.materials.resize(2);
    small.scene.materials[1].reflect = glm::vec3(1);
    small.scene.materials[1].transmit = glm::vec3(1);
    CHECK(included(small.effects()).empty());
}

TEST_CASE("geometry and lights and background and nodes call for theirs") {
    Small small;
    SUBCASE("spheres") {
        small.geometry.bodies.push_back({"ball", {}});
        small.geometry.primitives.push_back(small.geometry.primitives[0]);
        small.geometry.primitives[1].isSphere = true;
        small.geometry.primitives[1].body = 1;
        CHECK(included(small.effects()) == "spheres ");
        CHECK(reason(small.effects(), Effect::spheres) == "ball");
        CHECK(small.effects().has(Effect::triangles));
        small.geometry.primitives[0].isSphere = true;
        CHECK_FALSE(small.effects().has(Effect::triangles));
        CHECK(reason(small.effects(), Effect::triangles) == "every object is a sphere");
    }
    SUBCASE("smooth normals") {
        small.geometry.anySmooth = true;
        CHECK(included(small.effects()) == "smooth_normals ");
        CHECK(reason(small.effects(), Effect::smoothNormals) == "vertex normals that differ from their face's");
    }
    SUBCASE("lights") {
        small.light(LightType::directional).light(LightType::point);
        CHECK(included(small.effects()) == "point_lights directional_lights ");
        CHECK(reason(small.effects(), Effect::directionalLights) == "light 0");
        CHECK(reason(small.effects(), Effect::pointLights) == "light 1");
        CHECK(included(small.light(LightType::spot).effects()) == "point_lights directional_lights spot_lights ");
        CHECK(reason(small.effects(), Effect::spotLights) == "light 2");
    }
    SUBCASE("background") {
        small.scene.background.image = small.image("sky.hdr");
        CHECK(included(small.effects()) == "background_image ");
        CHECK(reason(small.effects(), Effect::backgroundImage) == "background 'sky.hdr'");
    }
    SUBCASE("float nodes") {
        small.floatNodes = true;
        CHECK(included(small.effects()) == "float_nodes ");
    }
}

TEST_CASE("what only path tracers read is called for only where one of them is in the blob") {
    const std::string because = "material 'paint' of thing";
    Small small;
    const auto check = [&](const std::string& whitted, const std::string& paths) {
        CHECK(included(small.effects()) == whitted);
        CHECK(included(small.paths().effects()) == paths);
    };
    SUBCASE("area lights") {
        small.paint().emission = {1, 0, 0};
        check("emission ", "area_lights emission ");
        CHECK(reason(small.effects(), Effect::areaLights) == because);
    }
    SUBCASE("the environment, unless it is black") {
        check("", "");
        small.scene.background.image = small.image("sky.hdr", {0, 0, 0, 1});
        CHECK(included(small.effects()) == "background_image ");
        small.scene.images[0].texels[0].g = 0.1f;
        CHECK(included(small.effects()) == "environment_light background_image ");
        CHECK(reason(small.effects(), Effect::environmentLight) == "background 'sky.hdr'");
        small.scene.background = {};
        small.scene.background.color = {0, 0, 1};
        CHECK(included(small.effects()) == "environment_light ");
        CHECK(reason(small.effects(), Effect::environmentLight) == "background");
    }
    SUBCASE("the lobes of a coat and of metal") {
        small.physical();
        check("", "");  // of index 1: matte
        small.paint().ior = 1.5f;
        CHECK(included(small.effects()) == "microfacets ");
        CHECK(reason(small.effects(), Effect::microfacets) == because);
        small.paint().ior = 1;
        small.physical().metallic = 0.5f;
        CHECK(included(small.effects()) == "microfacets ");
    }
    SUBCASE("rough glass, and no coat on what is all glass") {
        small.physical().transmission = 1;
        small.paint().ior = 1.5f;
        check("", "rough_transmission ");
        CHECK(reason(small.effects(), Effect::roughTransmission) == because);
        small.paint().physical->roughness = 0;
        CHECK(included(small.effects()).empty());
        small.paint().physical->transmission = 0.5f;
        CHECK(included(small.effects()) == "microfacets ");
    }
    SUBCASE("the lens") {
        small.scene.camera.aperture = 0.1;
        check("", "lens ");
        CHECK(reason(small.effects(), Effect::lens) == "the camera's aperture");
    }
    SUBCASE("base colours, which light from anywhere shows") {
        small.physical().metallic = 1;
        small.paint().diffuseTexture = small.image("gold.png");
        check("", "textures microfacets ");
    }
}

TEST_CASE("textures call for what reads them") {
    Small small;
    small.physical();
    SUBCASE("normal maps, unless they are flattened") {
        small.paint().normalTexture = small.image("bumps.png");
        CHECK(included(small.effects()) == "normal_maps ");
        small.paint().normalScale = 0;
        CHECK(included(small.effects()).empty());
    }
    SUBCASE("roughness and metallic") {
        small.paint().surfaceTexture = small.image("worn.png");
        CHECK(included(small.effects()).empty());  // only path tracers read it
        CHECK(included(small.paths().effects()) == "surface_maps ");
    }
    SUBCASE("emission") {
        small.paint().emissionTexture = small.image("screen.png");
        CHECK(included(small.effects()).empty());
        small.paint().emission = {1, 1, 1};
        CHECK(included(small.effects()) == "emission emission_maps ");
    }
    SUBCASE("alpha, where some of it is a hole") {
        small.paint().diffuseTexture = small.image("leaf.png", {1, 1, 1, 0.6f});
        CHECK(included(small.effects()).empty());
        small.paint().alphaMode = AlphaMode::mask;
        CHECK(included(small.effects()).empty());  // .6 is not under .5
        small.paint().alpha = 0.8f;
        CHECK(included(small.effects()) == "alpha ");
        small.paint().alpha = 1;
        small.paint().alphaMode = AlphaMode::blend;
        CHECK(included(small.effects()) == "alpha ");
        small.scene.images[0].texels[0].a = 1;
        CHECK(included(small.effects()).empty());
    }
}

TEST_CASE("asking for all effects adds those missing and keeps the reasons of the others") {
    Small small;
    small.paint().reflect = glm::vec3(1);
    EffectSet effects = small.effects();
    includeAll(effects);
    CHECK(reason(effects, Effect::reflection) == "material 'paint' of thing");
    CHECK(reason(effects, Effect::spheres) == "asked for by --all-effects");
    CHECK_FALSE(effects.has(Effect::floatNodes));  // a layout, not an addition
    CHECK_FALSE(effects.has(Effect::parity));      // a method
    CHECK_FALSE(effects.has(Effect::selfOverlap));
    CHECK_FALSE(effects.has(Effect::spectral));
    for (const Effect other : {Effect::floatNodes, Effect::parity, Effect::selfOverlap, Effect::spectral})
        effects[other].included = true;
    CHECK(
        std::all_of(effects.choices.begin(), effects.choices.end(), [](const EffectChoice& choice) { return choice.included; }));
}

TEST_CASE("a kernel without effects is smaller and has fewer bindings than one with all") {
    EffectSet all;
    includeAll(all);
    const Kernel pruned = compileKernel("whitted", EffectSet());
    const Kernel full = compileKernel("whitted", all);
    MESSAGE("words of SPIR-V: ", pruned.spirv.size(), " without effects, ", full.spirv.size(),
            " with all; bindings: ", bindingCount(pruned.bindings), " and ", bindingCount(full.bindings));
    CHECK(pruned.spirv.size() * 4 < full.spirv.size() * 3);
    const uint32_t ofOthers = 1u << MINIRT_BINDING_SPECTRUM | 1u << MINIRT_BINDING_EMITTERS | 1u << MINIRT_BINDING_ENVIRONMENT |
                              1u << MINIRT_BINDING_QUEUES;  // another method's; the path tracers'
    CHECK(full.bindings == (((1u << MINIRT_BINDING_COUNT) - 1) & ~ofOthers));
    const uint32_t ofEffects = 1u << MINIRT_BINDING_NORMALS | 1u << MINIRT_BINDING_UVS | 1u << MINIRT_BINDING_LIGHTS |
                               1u << MINIRT_BINDING_IMAGES | 1u << MINIRT_BINDING_TEXELS | 1u << MINIRT_BINDING_MEDIA;
    CHECK(pruned.bindings == (full.bindings & ~ofEffects));
}

// What is covered: all kernels without effects and the path tracer's with each effect alone are compiled, optimised and validated; the front end
// alone, which finds hooks that are missing, there twice or of another signature, sees all kernels with all effects, Whitted's with every pair of those
// that it reads, the path tracer's with 60 pairs drawn once and for all, and both with all effects but one.
TEST_CASE("every effect compiles alone") {
    std::vector<Choice> choices;
    for (const std::string& kernel : allKernels()) choices.push_back({kernel, EffectSet()});
    for (const Effect effect : effectsOf("path")) choices.push_back({"path", only({effect})});
    CHECK(choices.size() == 8 + kEffectCount);
    CHECK(compileAll(choices, compileWhole) == "");
}

TEST_CASE("effects are a program with and without each other") {
    const std::vector<Effect> ofWhitted = effectsOf("whitted");
    const std::vector<Effect> ofPath = effectsOf("path");
    CHECK(ofPath.size() == kEffectCount);
    CHECK(ofWhitted.size() == kEffectCount - 5);
    for (const Effect effect :
         {Effect::areaLights, Effect::environmentLight, Effect::microfacets, Effect::roughTransmission, Effect::lens})
        CHECK_FALSE(reads("whitted", effect));
    std::vector<Choice> choices;
    for (const std::string& kernel : allKernels()) {
        EffectSet all;
        for (const Effect effect : effectsOf(kernel)) all[effect].included = true;
        choices.push_back({kernel, all});
    }
    for (size_t a = 0; a < ofWhitted.size(); ++a)
        for (size_t b = a; b < ofWhitted.size(); ++b) choices.push_back({"whitted", only({ofWhitted[a], ofWhitted[b]})});
    std::mt19937 random(4);
    for (int i = 0; i < 60; ++i)
        choices.push_back({"path", only({ofPath[random() % kEffectCount], ofPath[random() % kEffectCount]})});
    for (const char* kernel : {"whitted", "path"}) {
        const std::vector<Effect> effects = effectsOf(kernel);
        for (const Effect left : effects) {
            EffectSet others;
            for (const Effect effect : effects) others[effect].included = effect != left;
            choices.push_back({kernel, others});
        }
    }
    compileKernel("rays", EffectSet());  // makes the front end ready
    CHECK(compileAll(choices, parseKernel) == "");
}
