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
    "model", "baseColor",    "metallic", "roughness",        "normalTexture",       "emissive",  "alphaMode",  "alphaCutoff",
    "thin",  "transmission", "ior",      "attenuationColor", "attenuationDistance", "inscatter", "dispersion", "glass"};
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

/// What a pbr material asks for that would make another picture than this version can draw.
void rejectUnsupported(const JsonObject& object, double metallic, double roughness, double transmission) {
    const std::string later = " is not in this version";
    object.word("alphaMode", "opaque", {"opaque"}, {"mask", "blend"});
    if (object.has("normalTexture")) object.fail("normalTexture", "'normalTexture'" + later, "leave it out");
    if (metallic > 0 && transmission > 0)
        object.fail("transmission", "a material cannot be metallic and transmissive", "set one of them to 0");
    if (transmission > 0 && roughness > 0)
        object.fail(object.has("roughness") ? "roughness" : "transmission", "transmission with roughness over 0" + later,
                    "set 'roughness' to 0 (its default is 0.5)");
    if (metallic > 0 && roughness > 0)
        object.fail(object.has("roughness") ? "roughness" : "metallic", "metallic with roughness over 0" + later,
                    "set 'roughness' to 0 (its default is 0.5)");
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

Material readPbr(SceneFile& file, const JsonValue& value, const std::string& what, Scene& scene) {
    const JsonObject object(file, value, what, kPbrKeys);
    const double metallic = object.number("metallic", 0, kZeroToOne);
    const double roughness = object.number("roughness", 0.5, kZeroToOne);
    const double transmission = object.number("transmission", 0, kZeroToOne);
    object.number("alphaCutoff", 0.5, kZeroToOne);
    rejectUnsupported(object, metallic, roughness, transmission);

    Material material;
    material.medium = readMedium(object);
    material.thin = object.boolean("thin", false);
    glm::vec3 baseColor(1);
    const JsonValue* base = object.find("baseColor");
    if (base && base->type == JsonType::string) {
        if (metallic > 0 || transmission > 0)
            object.fail("baseColor", "a texture on metal or glass is not in this version", "give 'baseColor' as [r, g, b]");
        material.diffuseTexture = addImage(scene, object.file("baseColor"));
    } else {
        baseColor = object.color("baseColor", baseColor, kZeroToOne);
    }
    material.diffuse = baseColor * static_cast<float>((1 - metallic) * (1 - transmission)) * glm::one_over_pi<float>();
    material.reflect = metallic > 0 ? baseColor * static_cast<float>(metallic) : glm::vec3(static_cast<float>(transmission));
    material.transmit = baseColor * static_cast<float>(transmission);
    material.fresnel = transmission > 0;
    readIndex(object, material);
    if (transmission == 0) warnOfNoInside(file, object, what);
    material.emission = object.color("emissive", glm::vec3(0), kNotNegative);
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

}  // namespace

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
    }
}

}  // namespace minirtc
