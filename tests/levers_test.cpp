#include "levers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "error.hpp"
#include "kernel.hpp"
#include "minirt.h"
#include "support.hpp"

using namespace minirtc;

namespace {

EffectSet only(std::initializer_list<Effect> wanted) {
    EffectSet effects;
    for (const Effect effect : wanted) effects[effect] = {true, "the case"};
    return effects;
}

EffectSet with(const LeverSettings& asked, EffectSet effects = {}) {
    applyToEffects(asked, effects);
    return effects;
}

std::string failure(const std::string& text) {
    LeverSettings settings;
    try {
        readSetting(text, settings);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// OpCapability Float64 anywhere in a module.
bool declaresDoubles(const std::vector<uint32_t>& spirv) {
    for (size_t i = 5; i < spirv.size() && spirv[i] >> 16; i += spirv[i] >> 16)
        if ((spirv[i] & 0xffffu) == 17 && spirv[i + 1] == 10) return true;
    return false;
}

}  // namespace

TEST_CASE("each lever is there once, its default is one of its settings, and what it does is said") {
    std::set<std::string> names, defines;
    size_t settingsWithCode = 0;
    for (const Lever& lever : levers()) {
        CAPTURE(lever.name);
        CHECK(names.insert(lever.name).second);
        CHECK_FALSE(lever.what.empty());
        CHECK_FALSE(lever.byDefault.empty());
        CHECK((lever.when == LeverTime::render) == !lever.option.empty());
        const std::vector<std::string> settings = settingNames(lever);
        if (!settings.empty()) CHECK(std::find(settings.begin(), settings.end(), lever.byDefault) != settings.end());
        for (const LeverSetting& setting : lever.settings) {
            CHECK_FALSE(setting.what.empty());
            if (setting.define.empty()) continue;
            settingsWithCode++;
            CHECK(defines.insert(setting.define).second);
            CHECK(setting.name != lever.byDefault);
        }
    }
    CHECK(settingsWithCode == 8);
    CHECK(bakeLeverNames().size() == 9);
}

TEST_CASE("a setting is read by its names, and what is wrong with it is told") {
    LeverSettings settings;
    readSetting("fresnel=none", settings);
    readSetting("fresnel=schlick", settings);
    readSetting("nesting=parity", settings);
    CHECK(settings == LeverSettings{{"fresnel", "schlick"}, {"nesting", "parity"}});
    CHECK(failure("fresnl=none") == "there is no lever 'fresnl'; did you mean 'fresnel'?");
    CHECK(failure("fresnel=shlick") == "the lever 'fresnel' has no setting 'shlick'; did you mean 'schlick'?");
    CHECK(failure("fresnel=") == "the lever 'fresnel' has no setting ''; known here: none, schlick, exact");
    CHECK(failure("fresnel") == "--set 'fresnel' is no LEVER=SETTING; such as fresnel=schlick; list them with: minirtc levers");
    CHECK(failure("depth=3") == "the lever 'depth' is set when a picture is rendered; use --max-depth of minirt-render");
}

TEST_CASE("a lever outweighs what the scene says, which outweighs the default") {
    Scene scene;
    CHECK(settingOf(findLever("nesting"), {}, scene) == "ordered");
    CHECK(settingOf(findLever("dispersion"), {}, scene) == "rgb");
    CHECK(settingOf(findLever("fresnel"), {}, scene) == "exact");
    scene.nesting = Nesting::parity;
    scene.render.dispersionMode = DispersionMode::spectral;
    CHECK(settingOf(findLever("nesting"), {}, scene) == "parity");
    CHECK(settingOf(findLever("dispersion"), {}, scene) == "spectral");
    const LeverSettings asked = {{"nesting", "ordered"}, {"dispersion", "rgb"}};
    CHECK(settingOf(findLever("nesting"), asked, scene) == "ordered");
    EffectSet parity = only({Effect::nesting, Effect::parity, Effect::dispersion, Effect::spectral});
    applyMethods({}, parity);
    CHECK(parity.has(Effect::parity));
    applyMethods({{"nesting", "off"}, {"dispersion", "off"}}, parity);
    CHECK(parity.has(Effect::parity));
    applyMethods(asked, parity);
    CHECK_FALSE(parity.has(Effect::parity));
    CHECK_FALSE(parity.has(Effect::spectral));
    CHECK(parity[Effect::parity].reason == effectInfo(Effect::parity).absent);
    applyMethods({{"nesting", "parity"}, {"dispersion", "spectral"}}, parity);
    CHECK(parity.has(Effect::parity));
    CHECK(parity.has(Effect::spectral));
    EffectSet plain = only({});
    applyMethods({{"nesting", "parity"}, {"dispersion", "spectral"}}, plain);
    CHECK_FALSE(plain.has(Effect::parity));
    CHECK_FALSE(plain.has(Effect::spectral));
}

TEST_CASE("a lever that is off leaves its effects out and says so") {
    const EffectSet called = only({Effect::smoothNormals, Effect::nesting, Effect::selfOverlap, Effect::absorption,
                                   Effect::inscatter, Effect::dispersion, Effect::spectral, Effect::fresnel});
    const EffectSet left = with({{"normals", "flat"}, {"nesting", "off"}, {"absorption", "off"}, {"dispersion", "off"}}, called);
    for (size_t i = 0; i < kEffectCount; ++i) CHECK(left.choices[i].included == (static_cast<Effect>(i) == Effect::fresnel));
    CHECK(left[Effect::inscatter].reason == "the lever absorption is set to off");
    CHECK(left[Effect::spheres].reason == called[Effect::spheres].reason);  // was out before
    CHECK(definesOf(left.levers).empty());
    CHECK(left.levers.size() == 4);
    CHECK(with({{"nesting", "ordered"}, {"fresnel", "exact"}}).levers.empty());
}

TEST_CASE("settings at their default leave the source of every kernel as it is") {
    LeverSettings defaults;
    for (const std::string& name : bakeLeverNames()) defaults[name] = findLever(name).byDefault;
    for (const char* kernel : {"whitted", "path", "wave_closest"})
        CHECK(composeKernel(kernel, with(defaults, only({Effect::fresnel}))) == composeKernel(kernel, only({Effect::fresnel})));
}

TEST_CASE("every setting with code of its own changes the kernels that read it, and they compile") {
    const EffectSet effects = only({Effect::triangles, Effect::spheres, Effect::reflection, Effect::refraction, Effect::fresnel,
                                    Effect::areaLights, Effect::emission, Effect::pointLights, Effect::roughTransmission});
    const Kernel path = compileKernel("path", effects), whitted = compileKernel("whitted", effects);
    CHECK_FALSE(declaresDoubles(path.spirv));
    for (const Lever& lever : levers())
        for (const LeverSetting& setting : lever.settings) {
            if (setting.define.empty()) continue;
            CAPTURE(setting.define);
            const bool ofWhitted = lever.name == "weak_rays";
            const Kernel& accurate = ofWhitted ? whitted : path;
            const Kernel cheap = compileKernel(accurate.name, with({{lever.name, setting.name}}, effects));
            CHECK(cheap.spirv != accurate.spirv);
            CHECK(cheap.bindings == accurate.bindings);
            CHECK(declaresDoubles(cheap.spirv) == (lever.name == "precision"));
        }
}

TEST_CASE("the cheapest and the dearest of all levers together compile in the kernels of every integrator") {
    LeverSettings cheapest, dearest;
    for (const std::string& name : bakeLeverNames()) {
        cheapest[name] = findLever(name).settings.front().name;
        dearest[name] = findLever(name).settings.back().name;
    }
    LeverSettings cheapDoubles = cheapest;
    cheapDoubles["precision"] = "double";
    EffectSet effects =
        only({Effect::triangles, Effect::spheres, Effect::refraction, Effect::fresnel, Effect::areaLights, Effect::emission});
    for (const LeverSettings& asked : {cheapest, dearest, cheapDoubles})
        for (const Integrator integrator : {Integrator::whitted, Integrator::wavefront})
            for (const std::string& kernel : kernelsOf(integrator, effects))
                CHECK_NOTHROW(compileKernel(kernel, with(asked, effects)));
}

TEST_CASE("a lever applies where the scene calls for what it changes") {
    const auto does = [](const char* lever, const EffectSet& effects, Integrator one = Integrator::whitted) {
        return applies(findLever(lever), effects, {one}).applies;
    };
    const std::pair<const char*, Effect> pairs[] = {
        {"fresnel", Effect::fresnel},   {"fresnel", Effect::roughTransmission}, {"normals", Effect::smoothNormals},
        {"nesting", Effect::nesting},   {"absorption", Effect::absorption},     {"dispersion", Effect::dispersion},
        {"cutoff", Effect::reflection}, {"depth", Effect::refraction},          {"weak_rays", Effect::refraction}};
    for (const auto& [lever, effect] : pairs) {
        CAPTURE(lever);
        CHECK_FALSE(does(lever, EffectSet()));
        CHECK(does(lever, only({effect})));
        CHECK(applies(findLever(lever), only({effect}), {Integrator::whitted}).reason == "the case");
    }
    for (const char* always : {"intersection", "ray_offset", "precision", "samples"}) CHECK(does(always, EffectSet()));
    CHECK(does("depth", EffectSet(), Integrator::path));
}

TEST_CASE("a lever of some integrators applies where one of them draws the scene") {
    const EffectSet effects = only({Effect::reflection, Effect::areaLights});
    const auto does = [&](const char* lever, const std::vector<Integrator>& integrators) {
        return applies(findLever(lever), effects, integrators).applies;
    };
    const std::vector<Integrator> whitted = {Integrator::whitted}, paths = {Integrator::path, Integrator::wavefront};
    for (const char* lever : {"cutoff", "weak_rays"}) {
        CHECK(does(lever, whitted));
        CHECK(does(lever, {Integrator::whitted, Integrator::path}));
        CHECK_FALSE(does(lever, paths));
    }
    CHECK_FALSE(does("light_sampling", whitted));
    CHECK(does("light_sampling", paths));
    CHECK(does("light_sampling", {Integrator::whitted, Integrator::wavefront}));
}

TEST_CASE("an effect is found by its name and left out where nothing calls for it") {
    CHECK(findEffect("smooth_normals") == Effect::smoothNormals);
    CHECK_THROWS_WITH(findEffect("spehres"), "there is no effect 'spehres'; did you mean 'spheres'?");
    EffectSet effects = only({Effect::spheres, Effect::floatNodes});
    CHECK_NOTHROW(removeEffect(effects, Effect::lens, false));
    CHECK_THROWS_WITH(removeEffect(effects, Effect::spheres, false),
                      "the effect 'spheres' is called for by the case; the picture would be another one without it; leave it out "
                      "all the same with --force");
    CHECK(effects.has(Effect::spheres));
    removeEffect(effects, Effect::spheres, true);
    CHECK_FALSE(effects.has(Effect::spheres));
    CHECK(effects[Effect::spheres].reason == "left out by --without");
    CHECK_THROWS_WITH(removeEffect(effects, Effect::floatNodes, true),
                      "the effect 'float_nodes' is the layout of the hierarchy; choose it with --layout");
}
