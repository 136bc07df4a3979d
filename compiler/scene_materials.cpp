#include "scene_materials.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "glasses.hpp"
#include "text_file.hpp"

namespace minirtc {
namespace {

const std::vector<std::string> kPhongKeys = {"model", "diffuse",   "specular", "reflect", "refract",
                                             "color", "shininess", "ior",      "fresnel", "thin"};
const std::vector<std::string> kPbrKeys = {
    "model",         "baseColor",   "metallic",         "roughness",           "metallicRoughnessTexture",
    "normalTexture", "normalScale", "emissive",         "emissiveTexture",     "doubleSided",
    "alpha",         "alphaMode",   "alphaCutoff",      "textureWrap",         "thin",
    "transmission",  "ior",         "attenuationColor", "attenuationDistance", "inscatter",
    "dispersion",    "glass"};
const std::vector<std::string> kCheckerKeys = {"model", "a", "b", "scale"};

Material readPhong(SceneFile& file, const JsonValue& value, const std::string& what) {
    const JsonObject object(file, value, what, kPhongKeys);
    const glm::vec3 color = object.color("color", glm::vec3(1), kNotNegative);
    const float reflect = static_cast<float>(object.number("reflect", 0, kNotNegative));
    const float refract = static_cast<float>(object.number("refract", 0, kNotNegative));
    Material material;
    material.diffuse = static_cast<float>(object.number("diffuse", 1, kNotNegative)) * color;
    material.specular = static_cast<float>(object.number("specular", 0, kNotNegative)) * color;
    material.shininess = static_cast<float>(object.number("shininess", 10, kPositive));
    material.ior = static_cast<float>(object.number("ior", 1.5, kPositive));
    material.fresnel = object.boolean("fresnel", false);
    // Fresnel shares out the sum of both weights; what has no refracted ray stays opaque.
    const bool shares = material.fresnel && refract > 0;
    material.reflect = glm::vec3(shares ? reflect + refract : reflect);
    material.transmit = glm::vec3(shares ? reflect + refract : refract);
    material.thin = object.boolean("thin", false);
    material.clearShadows = false;  // the shadows of the model are hard
    return material;
}

/// What contradicts itself.
void rejectImpossible(const JsonObject& object, const Physical& physical, bool thin, AlphaMode alphaMode) {
    const bool transmits = physical.transmission > 0;
    if (physical.metallic > 0 && transmits)
        object.fail("transmission", "a material cannot be metallic and transmissive", "set one of them to 0");
    if (thin && transmits && physical.roughness > 0)
        object.fail(object.has("roughness") ? "roughness" : "thin", "a thin sheet cannot be rough",
                    "set 'roughness' to 0 (its default is 0.5)");
    if (alphaMode != AlphaMode::opaque && transmits && !thin)
        object.fail("alphaMode", "what transmits fills a volume, whose surface cannot have holes",
                    "leave 'alphaMode' out, or add \"thin\": true");
}

/// What a pbr material asks for that only the path tracers can draw.
void leaveToPathTracers(SceneFile& file, const JsonObject& object, const Material& material, Scene& scene) {
    const Physical& physical = *material.physical;
    const char* kind = physical.metallic > 0 ? "metallic" : "transmission";
    if (physical.metallic == 0 && physical.transmission == 0) return;
    const auto leave = [&](const std::string& key, const std::string& what, const std::string& hint) {
        leaveWhittedOut(scene, file.at(*object.find(object.has(key) ? key : kind)), what, hint);
    };
    if (physical.roughness > 0)
        leave("roughness", std::string(kind) + " with roughness over 0", "set 'roughness' to 0 (its default is 0.5)");
    if (material.diffuseTexture != kNone) leave("baseColor", "a texture on metal or glass", "give 'baseColor' as [r, g, b]");
    if (material.surfaceTexture != kNone && physical.metallic > 0)
        leave("metallicRoughnessTexture", "a metal with a 'metallicRoughnessTexture'", "leave it out");
}

/// What light of `color` is left over `distance` metres, as a coefficient. Black is opaque after any distance that a float can tell.
float absorptionOf(float color, double distance) {
    constexpr double kOpaque = 1e30;
    const double sigma = color > 0 ? -std::log(double{color}) / distance : kOpaque;
    return static_cast<float>(std::clamp(sigma, 0.0, kOpaque));
}

Medium readMedium(const JsonObject& object) {
    const glm::vec3 color = object.color("attenuationColor", glm::vec3(1), kZeroToOne);
    const double distance = object.number("attenuationDistance", 1, kPositive);
    Medium medium;
    for (int i = 0; i < 3; ++i) medium.absorption[i] = absorptionOf(color[i], distance);
    medium.inscatter = static_cast<float>(object.number("inscatter", 0, kZeroToOne));
    return medium;
}

/// 'glass', or 'ior' and 'dispersion'.
void readIndex(const JsonObject& object, Material& material) {
    const double ior = object.number("ior", 1.5, kPositive);
    const double dispersion = object.number("dispersion", 0, kNotNegative);
    material.ior = static_cast<float>(ior);
    if (object.has("glass")) {
        for (const char* key : {"ior", "dispersion"})
            if (object.has(key))
                object.fail(key, "'" + std::string(key) + "' stands beside 'glass', which brings its own", "keep one of them");
        const std::string& name = object.text("glass");
        const Glass* glass = findGlass(name);
        if (!glass) object.fail("glass", "there is no glass " + inQuotes(name), suggestGlass(name));
        material.medium.dispersion = disperse(*glass);
        material.ior = static_cast<float>(indexOf(*glass, kLineD));
    } else if (dispersion > 0 && ior != 1) {
        const Dispersion d = disperse(ior, dispersion);
        const double ends = std::min(indexOn(d.curve, kVisibleFrom), indexOn(d.curve, kVisibleTo));
        if (!(std::min({ends, d.channels.r, d.channels.b}) > 0))
            object.fail("dispersion", "with this 'dispersion' the index of refraction is not over 0 for all visible light",
                        "glasses have 0.2 to 1: it is 20 over the Abbe number");
        material.medium.dispersion = d;
    }
}

/// Of an opaque material with keys that say what is inside.
void warnOfNoInside(const SceneFile& file, const JsonObject& object, const std::string& what) {
    for (const char* key : {"attenuationColor", "attenuationDistance", "inscatter", "dispersion", "glass"})
        if (const JsonValue* value = object.find(key))
            file.diagnostics.warn(file.at(*value), what + " is opaque: '" + key + "' tells of an inside that it does not have",
                                  "give it 'transmission' or leave the key out");
}

uint32_t readTexture(const JsonObject& object, const std::string& key, ColorSpace space, Scene& scene) {
    return object.has(key) ? addImage(scene, object.file(key), space) : kNone;
}

/// All textures but the base colour's, and how they wrap.
void readTextures(const JsonObject& object, Material& material, Scene& scene) {
    material.surfaceTexture = readTexture(object, "metallicRoughnessTexture", ColorSpace::linear, scene);
    material.normalTexture = readTexture(object, "normalTexture", ColorSpace::linear, scene);
    material.normalScale = static_cast<float>(object.number("normalScale", 1, kAnyNumber));
    material.emissionTexture = readTexture(object, "emissiveTexture", ColorSpace::srgb, scene);
    const std::string wrap = object.word("textureWrap", "repeat", {"repeat", "mirror", "clamp"});
    material.wrap = wrap == "repeat" ? Wrap::repeat : wrap == "mirror" ? Wrap::mirror : Wrap::clamp;
}

void readAlpha(const JsonObject& object, Material& material) {
    const std::string mode = object.word("alphaMode", "opaque", {"opaque", "mask", "blend"});
    material.alphaMode = mode == "opaque" ? AlphaMode::opaque : mode == "mask" ? AlphaMode::mask : AlphaMode::blend;
    material.alpha = static_cast<float>(object.number("alpha", 1, kZeroToOne));
    material.alphaCutoff = static_cast<float>(object.number("alphaCutoff", 0.5, kZeroToOne));
}

/// What the Whitted kernel knows of a physical material.
void setWeights(const Physical& physical, Material& material) {
    const auto& [baseColor, metallic, roughness, transmission] = physical;
    material.diffuse = baseColor * ((1 - metallic) * (1 - transmission)) * glm::one_over_pi<float>();
    material.reflect = metallic > 0 ? baseColor * metallic : glm::vec3(transmission);
    material.transmit = baseColor * transmission;
    material.fresnel = transmission > 0;
}

Material readPbr(SceneFile& file, const JsonValue& value, const std::string& what, Scene& scene) {
    const JsonObject object(file, value, what, kPbrKeys);
    Material material;
    Physical physical;
    physical.metallic = static_cast<float>(object.number("metallic", 0, kZeroToOne));
    physical.roughness = static_cast<float>(object.number("roughness", 0.5, kZeroToOne));
    physical.transmission = static_cast<float>(object.number("transmission", 0, kZeroToOne));
    material.thin = object.boolean("thin", false);
    readAlpha(object, material);
    rejectImpossible(object, physical, material.thin, material.alphaMode);

    const JsonValue* base = object.find("baseColor");
    if (base && base->type == JsonType::string)
        material.diffuseTexture = addImage(scene, object.file("baseColor"), ColorSpace::srgb);
    else
        physical.baseColor = object.color("baseColor", physical.baseColor, kZeroToOne);
    readTextures(object, material, scene);
    material.medium = readMedium(object);
    readIndex(object, material);
    if (physical.transmission == 0) warnOfNoInside(file, object, what);
    setWeights(physical, material);
    material.emission = object.color("emissive", glm::vec3(0), kNotNegative);
    material.doubleSided = object.boolean("doubleSided", false);
    material.physical = physical;
    leaveToPathTracers(file, object, material, scene);
    return material;
}

Material readChecker(SceneFile& file, const JsonValue& value, const std::string& what) {
    const JsonObject object(file, value, what, kCheckerKeys);
    Material material;
    material.checker = true;
    material.checkerScale = static_cast<float>(object.number("scale", 1, kPositive));
    object.text("a");
    object.text("b");
    return material;
}

std::string readModel(SceneFile& file, const JsonValue& value, const std::string& what) {
    requireType(file, value, what, JsonType::object);
    const JsonValue* model = value.find("model");
    if (!model) throw Error(file.at(value), what + " has no 'model'", "add \"model\": \"phong\", \"pbr\" or \"checker\"");
    requireType(file, *model, "'model'", JsonType::string);
    const std::vector<std::string> known = {"phong", "pbr", "checker"};
    for (const std::string& name : known)
        if (model->string == name) return name;
    throw Error(file.at(*model), "'model' is " + inQuotes(model->string), suggest(model->string, known));
}

uint32_t findCheckerPart(const SceneFile& file, const JsonValue& name, const Scene& scene) {
    const uint32_t index = findMaterial(file, name, scene);
    if (scene.materials[index].checker)
        throw Error(file.at(name), inQuotes(name.string) + " is a checker itself", "name a phong or pbr material");
    if (boundsVolume(scene.materials[index]))
        throw Error(file.at(name), inQuotes(name.string) + " transmits light, and a checker of it would have two insides",
                    "name an opaque material, or one with \"thin\": true");
    return index;
}

/// Gives a checker that shines materials of its own: how densely points are picked as lights is theirs, and differs from that of surfaces that
/// are all of one of them.
void ownParts(Scene& scene, uint32_t checker) {
    const auto shines = [&](uint32_t part) { return scene.materials[part].emission != glm::vec3(0); };
    if (!shines(scene.materials[checker].checkerA) && !shines(scene.materials[checker].checkerB)) return;
    for (uint32_t Material::*const part : {&Material::checkerA, &Material::checkerB}) {
        Material own = scene.materials[scene.materials[checker].*part];
        own.name += " in " + scene.materials[checker].name;
        scene.materials[checker].*part = static_cast<uint32_t>(scene.materials.size());
        scene.materials.push_back(own);
    }
}

}  // namespace

bool isTextured(const Material& m) {
    return m.diffuseTexture != kNone || m.surfaceTexture != kNone || m.normalTexture != kNone || m.emissionTexture != kNone;
}

void leaveWhittedOut(Scene& scene, const SourceLocation& location, const std::string& what, const std::string& hint) {
    RenderDefaults& render = scene.render;
    auto& all = render.integrators;
    if (followsTrees(render.integrator))
        throw Error(location, "the integrator 'whitted' cannot draw " + what, hint + ", or draw with \"integrator\": \"path\"");
    if (std::any_of(all.begin(), all.end(), followsTrees) && render.integratorsGiven)
        throw Error(location, "the integrator 'whitted' cannot draw " + what, hint + ", or leave it out of 'integrators'");
    all.erase(std::remove_if(all.begin(), all.end(), followsTrees), all.end());
}

bool boundsVolume(const Material& material) {
    return !material.checker && !material.thin && material.transmit != glm::vec3(0);
}

uint32_t findMaterial(const SceneFile& file, const JsonValue& name, const Scene& scene) {
    requireType(file, name, "a material's name", JsonType::string);
    for (uint32_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].name == name.string) return i;
    std::vector<std::string> known;
    for (const Material& material : scene.materials) known.push_back(material.name);
    throw Error(file.at(name), "there is no material " + inQuotes(name.string),
                known.empty() ? "add it under 'materials'" : suggest(name.string, known));
}

void readMaterials(SceneFile& file, const JsonValue& materials, Scene& scene) {
    requireType(file, materials, "'materials'", JsonType::object);
    for (const JsonMember& member : materials.members) {
        const std::string what = "the material " + inQuotes(member.key);
        const std::string model = readModel(file, member.value, what);
        Material material = model == "phong" ? readPhong(file, member.value, what)
                            : model == "pbr" ? readPbr(file, member.value, what, scene)
                                             : readChecker(file, member.value, what);
        material.name = member.key;
        scene.materials.push_back(material);
    }
    for (size_t i = 0; i < materials.members.size(); ++i) {
        if (!scene.materials[i].checker) continue;
        const JsonValue& checker = materials.members[i].value;
        scene.materials[i].checkerA = findCheckerPart(file, *checker.find("a"), scene);
        scene.materials[i].checkerB = findCheckerPart(file, *checker.find("b"), scene);
        ownParts(scene, static_cast<uint32_t>(i));
    }
}

}  // namespace minirtc
