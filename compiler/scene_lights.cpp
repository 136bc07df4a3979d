#include "scene_lights.hpp"

#include <cmath>
#include <map>

#include "scene_shapes.hpp"

namespace minirtc {
namespace {

Light readDirectional(SceneFile& file, const JsonValue& value) {
    const JsonObject object(file, value, "a directional light", {"type", "direction", "irradiance"});
    Light light;
    light.type = LightType::directional;
    light.direction = readDirection(object);
    light.intensity = object.color("irradiance", glm::vec3(1), kNotNegative);
    return light;
}

/// What point and spot lights share.
Light readPositional(const JsonObject& object) {
    Light light;
    object.require("position");
    light.position = object.vector("position", {});
    light.intensity = object.color("intensity", glm::vec3(1), kNotNegative);
    light.inverseSquare = object.word("falloff", "inverse-square", {"inverse-square", "none"}) == "inverse-square";
    return light;
}

Light readPoint(SceneFile& file, const JsonValue& value) {
    return readPositional({file, value, "a point light", {"type", "position", "intensity", "falloff"}});
}

Light readSpot(SceneFile& file, const JsonValue& value) {
    const JsonObject object(file, value, "a spot light",
                            {"type", "position", "direction", "intensity", "innerConeAngle", "outerConeAngle", "falloff"});
    Light light = readPositional(object);
    light.type = LightType::spot;
    light.direction = readDirection(object);
    light.outerCone = object.number("outerConeAngle", light.outerCone, {0, 90, false});
    light.innerCone = object.number("innerConeAngle", light.innerCone, {0, 90});
    if (light.innerCone > light.outerCone)
        object.fail("innerConeAngle", "the inner cone is wider than the outer one",
                    "make 'outerConeAngle' (its default is 45) at least as wide");
    return light;
}

/// What a light with size is made of: it shines and reflects nothing.
uint32_t addGlow(Scene& scene, const std::string& name, const glm::vec3& radiance) {
    Material glow;
    glow.name = name;
    glow.emission = radiance;
    glow.physical = Physical{glm::vec3(0), 0, 1, 0};
    scene.materials.push_back(glow);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

Object readShining(SceneFile& file, const JsonValue& value, const std::string& name, Scene& scene) {
    const bool round = value.find("type")->string == "sphere";
    const std::vector<std::string> keys = round ? std::vector<std::string>{"type", "radiance", "center", "radius"}
                                                : std::vector<std::string>{"type", "radiance", "origin", "u", "v"};
    const JsonObject object(file, value, round ? "a sphere light" : "a rectangle light", keys);
    Object shining;
    shining.name = name;
    shining.location = file.at(value);
    shining.shape = round ? ShapeType::sphere : ShapeType::rectangle;
    if (round)
        shining.sphere = readSphereShape(object);
    else
        shining.rectangle = readRectangleShape(object, "the light");
    shining.material = addGlow(scene, name, object.color("radiance", glm::vec3(1), kNotNegative));
    return shining;
}

/// The type, after a look at the keys of all kinds of light: a mistyped key is told before a missing one.
std::string readType(SceneFile& file, const JsonValue& value) {
    const JsonObject any(file, value, "a light",
                         {"type", "position", "intensity", "falloff", "direction", "irradiance", "innerConeAngle",
                          "outerConeAngle", "origin", "u", "v", "center", "radius", "radiance"});
    any.require("type");
    return any.word("type", "", {"point", "directional", "spot", "rectangle", "sphere"});
}

}  // namespace

SpotCosines spotCosines(const Light& spot) {
    return {static_cast<float>(std::cos(glm::radians(spot.innerCone))),
            static_cast<float>(std::cos(glm::radians(spot.outerCone)))};
}

std::vector<Object> readLights(SceneFile& file, const JsonValue& lights, Scene& scene) {
    requireType(file, lights, "'lights'", JsonType::array);
    std::vector<Object> shining;
    std::map<std::string, int> numbers;
    for (const JsonValue& value : lights.items) {
        requireType(file, value, "a light", JsonType::object);
        const std::string type = readType(file, value);
        if (type == "rectangle" || type == "sphere")
            shining.push_back(readShining(file, value, type + " light " + std::to_string(++numbers[type]), scene));
        else
            scene.lights.push_back(type == "point"  ? readPoint(file, value)
                                   : type == "spot" ? readSpot(file, value)
                                                    : readDirectional(file, value));
    }
    return shining;
}

}  // namespace minirtc
