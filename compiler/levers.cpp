#include "levers.hpp"

#include <algorithm>

#include "error.hpp"
#include "json_fields.hpp"
#include "text_file.hpp"

namespace minirtc {
namespace {

const std::vector<Lever> kLevers = {
    {"intersection",
     LeverTime::bake,
     "how a ray is tested against a triangle",
     {{"moller_trumbore_epsilon", "Moeller and Trumbore 1997; determinants and distances under 1e-3 are misses (miniRTRender)",
       "INTERSECTION_MOLLER_TRUMBORE_EPSILON"},
      {"moller_trumbore", "Moeller and Trumbore 1997; only a determinant of 0 is a miss", "INTERSECTION_MOLLER_TRUMBORE"},
      {"watertight", "Woop, Benthin and Wald 2013: no gap along an edge that two triangles share", ""}},
     "watertight",
     ""},
    {"ray_offset",
     LeverTime::bake,
     "how far off a surface the rays start that leave it",
     {{"constant", "1e-3 along the normal (miniRTRender)", "RAY_OFFSET_CONSTANT"},
      {"distance_scaled", "1e-5 and 1e-4 of the distance to the camera (miniRTRender's getDynamicEpsilon)",
       "RAY_OFFSET_DISTANCE_SCALED"},
      {"error_bounded", "just out of the box of errors around the point (pbrt-v4, section 6.8)", ""}},
     "error_bounded",
     ""},
    {"fresnel",
     LeverTime::bake,
     "how a smooth surface splits light",
     {{"none", "all light goes through but where reflection is total", "FRESNEL_NONE"},
      {"schlick", "Schlick 1994, by the cosine on the side of the ray", "FRESNEL_SCHLICK"},
      {"exact", "Fresnel's equations, unpolarised", ""}},
     "exact",
     ""},
    {"normals",
     LeverTime::bake,
     "what surfaces are shaded by",
     {{"flat", "the normals of the faces", ""}, {"smooth", "the normals of the vertices, interpolated", ""}},
     "smooth",
     ""},
    {"nesting",
     LeverTime::bake,
     "how rays keep track of the volumes that they are in",
     {{"off", "not at all: the side that a ray comes from says it all", ""},
      {"parity", "a stack, in which the first of two surfaces that overlap counts (Ray Tracing Gems, ch. 11)", ""},
      {"ordered", "a set, of which one volume displaces the others, the same for every ray", ""}},
     "ordered",
     ""},
    {"absorption",
     LeverTime::bake,
     "what media do to light on its way",
     {{"off", "nothing: all media are clear, and none has a colour of its own", ""},
      {"on", "Beer and Lambert, and the media's own colour", ""}},
     "on",
     ""},
    {"dispersion",
     LeverTime::bake,
     "how light of different wavelengths parts where it refracts",
     {{"off", "one index of refraction for all light", ""},
      {"rgb", "three channels, with an index each", ""},
      {"spectral", "four wavelengths a sample (Wilkie et al. 2014)", ""}},
     "rgb",
     ""},
    {"precision",
     LeverTime::bake,
     "of the intersection with a primitive and of the point that is hit",
     {{"float", "32 bits", ""}, {"double", "64 bits, on devices with shaderFloat64", "PRECISION_DOUBLE"}},
     "float",
     ""},
    {"weak_rays",
     LeverTime::bake,
     "what becomes of rays of Whitted's tracer that carry no more than the cut-off",
     {{"dropped", "they end", ""},
      {"roulette",
       "they survive with the probability of their share of it, and carry it then: noise instead of bias (Arvo and Kirk 1990)",
       "WEAK_RAYS_ROULETTE"}},
     "dropped",
     ""},
    {"depth", LeverTime::render, "bounces after the camera ray", {}, "the scene's maxDepth", "--max-depth"},
    {"cutoff",
     LeverTime::render,
     "of Whitted's tracer: rays are weak that carry no more than this share of the light; 0: none is",
     {},
     "1/512",
     "--cutoff"},
    {"samples", LeverTime::render, "samples a pixel", {}, "the scene's spp", "--spp"},
    {"light_sampling",
     LeverTime::render,
     "how path tracers find light",
     {{"surfaces", "by following surfaces alone", ""},
      {"lights", "by picking lights alone: next-event estimation", ""},
      {"balance", "by both, weighed by the balance heuristic (Veach 1997)", ""},
      {"mis", "by both, weighed by the power heuristic (Veach 1997)", ""}},
     "mis",
     "--light-sampling"},
};

/// Asked for, or "".
std::string asked(const LeverSettings& settings, const std::string& lever) {
    const auto found = settings.find(lever);
    return found == settings.end() ? "" : found->second;
}

void leaveOut(EffectSet& effects, Effect effect, const std::string& lever, const std::string& setting) {
    if (effects.has(effect)) effects[effect] = {false, "the lever " + lever + " is set to " + setting};
}

/// The first of `wanted` that a scene calls for decides; without any, why the first is out.
Applicability anyOf(const EffectSet& effects, const std::vector<Effect>& wanted) {
    for (const Effect effect : wanted)
        if (effects.has(effect)) return {true, effects[effect].reason};
    return {false, effects[wanted[0]].reason};
}

}  // namespace

const std::vector<Lever>& levers() {
    return kLevers;
}

std::vector<std::string> bakeLeverNames() {
    std::vector<std::string> names;
    for (const Lever& lever : kLevers)
        if (lever.when == LeverTime::bake) names.push_back(lever.name);
    return names;
}

std::vector<std::string> settingNames(const Lever& lever) {
    std::vector<std::string> names;
    for (const LeverSetting& setting : lever.settings) names.push_back(setting.name);
    return names;
}

const Lever& findLever(const std::string& name) {
    const auto found = std::find_if(kLevers.begin(), kLevers.end(), [&](const Lever& lever) { return lever.name == name; });
    if (found == kLevers.end()) throw Error("there is no lever " + inQuotes(name), suggest(name, bakeLeverNames()));
    return *found;
}

void requireSetting(const std::string& name, const std::string& setting) {
    const Lever& lever = findLever(name);
    if (lever.when == LeverTime::render)
        throw Error("the lever '" + name + "' is set when a picture is rendered", "use " + lever.option + " of minirt-render");
    const std::vector<std::string> known = settingNames(lever);
    if (std::find(known.begin(), known.end(), setting) == known.end())
        throw Error("the lever '" + name + "' has no setting " + inQuotes(setting), suggest(setting, known));
}

void readSetting(const std::string& text, LeverSettings& settings) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos)
        throw Error("--set " + inQuotes(text) + " is no LEVER=SETTING",
                    "such as fresnel=schlick; list them with: minirtc levers");
    requireSetting(text.substr(0, equals), text.substr(equals + 1));
    settings[text.substr(0, equals)] = text.substr(equals + 1);
}

std::string settingOf(const Lever& lever, const LeverSettings& settings, const Scene& scene) {
    std::string wanted = asked(settings, lever.name);
    if (!wanted.empty()) return wanted;
    if (lever.name == "nesting") return scene.nesting == Nesting::parity ? "parity" : "ordered";
    if (lever.name == "dispersion") return scene.render.dispersionMode == DispersionMode::spectral ? "spectral" : "rgb";
    return lever.byDefault;
}

void applyMethods(const LeverSettings& settings, EffectSet& effects) {
    const struct {
        const char* lever;
        const char* without;
        const char* with;
        Effect whole, method;
        const char* reason;
    } methods[] = {{"nesting", "ordered", "parity", Effect::nesting, Effect::parity, "\"nesting\": \"parity\""},
                   {"dispersion", "rgb", "spectral", Effect::dispersion, Effect::spectral, "\"dispersionMode\": \"spectral\""}};
    for (const auto& m : methods) {
        const std::string setting = asked(settings, m.lever);
        if (setting == m.without) effects[m.method] = {false, effectInfo(m.method).absent};
        if (setting == m.with && effects.has(m.whole)) effects[m.method] = {true, m.reason};
    }
}

void applyToEffects(const LeverSettings& settings, EffectSet& effects) {
    const struct {
        const char* lever;
        const char* setting;
        std::vector<Effect> effects;
    } removals[] = {{"normals", "flat", {Effect::smoothNormals}},
                    {"nesting", "off", {Effect::nesting, Effect::parity, Effect::selfOverlap}},
                    {"absorption", "off", {Effect::absorption, Effect::inscatter}},
                    {"dispersion", "off", {Effect::dispersion, Effect::spectral}}};
    for (const auto& removal : removals)
        if (asked(settings, removal.lever) == removal.setting)
            for (const Effect effect : removal.effects) leaveOut(effects, effect, removal.lever, removal.setting);
    for (const auto& [lever, setting] : settings)
        if (setting != findLever(lever).byDefault) effects.levers[lever] = setting;
}

std::vector<std::string> definesOf(const LeverSettings& settings) {
    std::vector<std::string> defines;
    for (const Lever& lever : kLevers)
        for (const LeverSetting& setting : lever.settings)
            if (!setting.define.empty() && asked(settings, lever.name) == setting.name) defines.push_back(setting.define);
    return defines;
}

Applicability applies(const Lever& lever, const EffectSet& effects, const std::vector<Integrator>& integrators) {
    const bool whitted = std::any_of(integrators.begin(), integrators.end(), followsTrees);
    const bool paths = !std::all_of(integrators.begin(), integrators.end(), followsTrees);
    const bool ofWhitted = lever.name == "cutoff" || lever.name == "weak_rays";
    if (ofWhitted && !whitted) return {false, "the scene does not ask for Whitted's tracer"};
    if (lever.name == "light_sampling" && !paths) return {false, "nothing traces paths"};
    if (lever.name == "fresnel") return anyOf(effects, {Effect::fresnel, Effect::roughTransmission});
    if (lever.name == "normals") return anyOf(effects, {Effect::smoothNormals});
    if (lever.name == "nesting") return anyOf(effects, {Effect::nesting});
    if (lever.name == "absorption") return anyOf(effects, {Effect::absorption, Effect::inscatter});
    if (lever.name == "dispersion") return anyOf(effects, {Effect::dispersion});
    if (ofWhitted || (lever.name == "depth" && !paths)) return anyOf(effects, {Effect::reflection, Effect::refraction});
    if (lever.name == "light_sampling") return anyOf(effects, {Effect::areaLights, Effect::environmentLight});
    return {true, "every scene has rays that meet surfaces"};
}

}  // namespace minirtc
