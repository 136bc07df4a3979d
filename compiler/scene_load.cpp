#include <algorithm>
#include <cmath>
#include <map>

#include "json_fields.hpp"
#include "scene.hpp"
#include "scene_materials.hpp"
#include "text_file.hpp"

namespace minirtc {
namespace {

using Paths = std::map<std::filesystem::path, uint32_t>;

Camera readCamera(SceneFile& file, const JsonValue& value) {
    const JsonObject object(file, value, "the camera", {"position", "target", "up", "vfov", "aperture", "focusDistance"});
    Camera camera;
    camera.position = object.vector("position", camera.position);
    camera.target = object.vector("target", camera.target);
    camera.up = object.vector("up", camera.up);
    camera.vfov = object.number("vfov", camera.vfov, {0, 180, false, false});
    camera.aperture = object.number("aperture", 0, kNotNegative);
    camera.focusDistance = object.number("focusDistance", 1, kPositive);
    if (camera.aperture > 0) object.fail("aperture", "an aperture over 0 is not in this version", "set it to 0");

    const glm::dvec3 view = camera.target - camera.position;
    constexpr double kParallel = 1e-6;  // sine of the angle below which the picture's upright is lost in rounding
    if (glm::length(view) == 0) object.fail("target", "the camera's position and target are the same point", "move one of them");
    if (glm::length(camera.up) == 0) object.fail("up", "the camera's 'up' has no length", "give a direction such as [0, 1, 0]");
    if (glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) < kParallel)
        object.fail("up", "the camera's 'up' is parallel to the view", "give another 'up', such as [0, 0, 1]");
    return camera;
}

Background readBackground(SceneFile& file, const JsonValue& value, Scene& scene) {
    const JsonObject object(file, value, "the background", {"image", "color", "strength", "rotation"});
    if (object.has("image") && object.has("color"))
        object.fail("color", "the background has both 'image' and 'color'", "keep one of them");
    Background background;
    background.strength = static_cast<float>(object.number("strength", 1, kNotNegative));
    background.rotation = static_cast<float>(object.number("rotation", 0, kAnyNumber));
    background.color = object.color("color", glm::vec3(0), kNotNegative) * background.strength;
    if (!std::isfinite(background.color.r + background.color.g + background.color.b))
        object.fail("strength", "'color' times 'strength' is too large", "single precision ends at 3.4e38");
    if (object.has("image")) background.image = addImage(scene, object.file("image"));
    return background;
}

Light readLight(SceneFile& file, const JsonValue& value) {
    requireType(file, value, "a light", JsonType::object);
    const bool directional = value.find("type") && value.find("type")->string == "directional";
    const std::string what = directional ? "a directional light" : "a light";
    const JsonObject kind(file, value, what,
                          {"type", "position", "intensity", "falloff", "direction", "irradiance", "innerAngle", "outerAngle",
                           "origin", "u", "v", "radiance"});
    kind.require("type");
    kind.word("type", "", {"point", "directional"}, {"spot", "rectangle"});

    Light light;
    if (directional) {
        const JsonObject object(file, value, what, {"type", "direction", "irradiance"});
        light.type = LightType::directional;
        object.require("direction");
        light.direction = object.vector("direction", {});
        light.intensity = object.color("irradiance", glm::vec3(1), kNotNegative);
        if (glm::length(light.direction) == 0)
            object.fail("direction", "'direction' has no length", "give the way the light travels");
    } else {
        const JsonObject object(file, value, "a point light", {"type", "position", "intensity", "falloff"});
        object.require("position");
        light.position = object.vector("position", {});
        light.intensity = object.color("intensity", glm::vec3(1), kNotNegative);
        light.inverseSquare = object.word("falloff", "inverse-square", {"inverse-square", "none"}) == "inverse-square";
    }
    return light;
}

RenderDefaults readRender(SceneFile& file, const JsonValue& value) {
    const JsonObject object(file, value, "the render section",
                            {"integrator", "integrators", "maxDepth", "spp", "size", "shadows", "dispersionMode"});
    RenderDefaults render;
    object.word("integrator", "whitted", {"whitted"}, {"path", "wavefront"});
    const std::string shadows = object.word("shadows", "", {"transmissive", "opaque"});
    if (!shadows.empty()) render.shadows = shadows == "opaque" ? Shadows::opaque : Shadows::transmissive;
    const bool spectral = object.word("dispersionMode", "rgb", {"rgb", "spectral"}) == "spectral";
    render.dispersionMode = spectral ? DispersionMode::spectral : DispersionMode::rgb;
    if (object.has("integrators")) object.warnIgnored("integrators", "there is one integrator");
    render.maxDepth = object.integer("maxDepth", render.maxDepth, 0, 255);
    render.spp = object.integer("spp", render.spp, 1, 65536);
    if (const JsonValue* size = object.find("size")) {
        const std::string hint = "give [width, height] in whole pixels from 1 to 16384";
        const auto pixels = [](const JsonValue& v) {
            return v.type == JsonType::number && v.number == std::floor(v.number) && v.number >= 1 && v.number <= 16384;
        };
        if (size->type != JsonType::array || size->items.size() != 2)
            object.fail("size", "'size' is not a pair of numbers", hint);
        for (const JsonValue& side : size->items)
            if (!pixels(side)) throw Error(file.at(side), "this is no size of a picture", hint);
        render.width = static_cast<uint32_t>(size->items[0].number);
        render.height = static_cast<uint32_t>(size->items[1].number);
    }
    return render;
}

const std::vector<std::string> kTransformKeys = {"scale", "rotate", "translate"};

Transform readTransform(const JsonObject& object, SceneFile& file) {
    Transform transform;
    if (const JsonValue* scale = object.find("scale")) {
        if (scale->type == JsonType::number)
            transform.scale = glm::dvec3(readNumber(file, *scale, "scale"));
        else if (scale->type == JsonType::array)
            transform.scale = readVector(file, *scale, "scale");
        else
            object.fail("scale", "'scale' is " + describe(scale->type), "give a number or an array of 3 numbers");
        for (int i = 0; i < 3; ++i)
            if (transform.scale[i] == 0) object.fail("scale", "'scale' is zero", "no axis may be scaled to nothing");
    }
    transform.rotate = object.vector("rotate", transform.rotate);
    transform.translate = object.vector("translate", transform.translate);
    return transform;
}

std::vector<Transform> readInstances(const JsonObject& object, SceneFile& file) {
    const JsonValue* instances = object.find("instances");
    if (!instances) return {readTransform(object, file)};
    for (const std::string& key : kTransformKeys)
        if (object.has(key))
            object.fail(key, "an object with 'instances' has '" + key + "' of its own", "move it into each instance");
    requireType(file, *instances, "'instances'", JsonType::array);
    if (instances->items.empty()) object.fail("instances", "'instances' is empty", "give one transform or leave it out");
    std::vector<Transform> transforms;
    for (const JsonValue& value : instances->items)
        transforms.push_back(readTransform(JsonObject(file, value, "an instance", kTransformKeys), file));
    return transforms;
}

/// Everything about a mesh object but the mesh itself, which is loaded once all its users are known.
Object readMeshObject(SceneFile& file, const JsonValue& value, const Scene& scene, Paths& meshes) {
    const JsonObject object(file, value, "a mesh object",
                            {"mesh", "material", "scale", "rotate", "translate", "smooth", "instances", "priority"});
    Object mesh;
    mesh.shape = ShapeType::mesh;
    mesh.name = object.text("mesh");
    mesh.mesh = meshes.emplace(object.file("mesh"), static_cast<uint32_t>(meshes.size())).first->second;
    const JsonValue* material = object.find("material");
    if (material && material->type != JsonType::null) mesh.material = findMaterial(file, *material, scene);
    if (object.has("smooth")) mesh.smooth = object.boolean("smooth", false);
    mesh.instances = readInstances(object, file);
    return mesh;
}

uint32_t readShapeMaterial(const SceneFile& file, const JsonObject& object, const Scene& scene) {
    const JsonValue& material = object.require("material");
    if (material.type == JsonType::null) object.fail("material", "only a mesh brings a material of its own", "name a material");
    return findMaterial(file, material, scene);
}

Object readSphere(SceneFile& file, const JsonValue& value, const Scene& scene) {
    const JsonObject object(file, value, "a sphere object", {"sphere", "material", "priority"});
    const JsonObject shape(file, *object.find("sphere"), "a sphere", {"center", "radius"});
    Object sphere;
    sphere.shape = ShapeType::sphere;
    sphere.name = "sphere";
    sphere.sphere.center = shape.vector("center", sphere.sphere.center);
    sphere.sphere.radius = shape.number("radius", sphere.sphere.radius, kPositive);
    sphere.material = readShapeMaterial(file, object, scene);
    const Material& material = scene.materials[sphere.material];
    const auto textured = [&](uint32_t m) { return m != kNone && scene.materials[m].diffuseTexture != kNone; };
    if (material.diffuseTexture != kNone || textured(material.checkerA) || textured(material.checkerB))
        object.fail("material", "a texture on a sphere is not in this version", "use a plain colour or a mesh");
    return sphere;
}

Object readRectangle(SceneFile& file, const JsonValue& value, const Scene& scene) {
    const JsonObject object(file, value, "a rectangle object", {"rectangle", "material", "priority"});
    const JsonObject shape(file, *object.find("rectangle"), "a rectangle", {"origin", "u", "v"});
    Object rectangle;
    rectangle.shape = ShapeType::rectangle;
    rectangle.name = "rectangle";
    rectangle.rectangle.origin = shape.vector("origin", rectangle.rectangle.origin);
    shape.require("u");
    shape.require("v");
    rectangle.rectangle.u = shape.vector("u", {});
    rectangle.rectangle.v = shape.vector("v", {});
    rectangle.material = readShapeMaterial(file, object, scene);
    const double u = glm::length(rectangle.rectangle.u), v = glm::length(rectangle.rectangle.v);
    const double area = glm::length(glm::cross(rectangle.rectangle.u, rectangle.rectangle.v));
    constexpr double kThinnest = 1e-7;  // sine of the angle between u and v: thinner is a line in single precision
    if (!(area > kThinnest * u * v))
        object.fail("rectangle", "the rectangle has no area", "'u' and 'v' must differ in direction");
    return rectangle;
}

Object readObject(SceneFile& file, const JsonValue& value, const Scene& scene, Paths& meshes) {
    requireType(file, value, "an object", JsonType::object);
    const std::vector<std::string> shapes = {"mesh", "sphere", "rectangle"};
    const auto count =
        std::count_if(shapes.begin(), shapes.end(), [&](const std::string& s) { return value.find(s) != nullptr; });
    if (count > 1) throw Error(file.at(value), "an object has more than one shape", "split it into one object a shape");
    if (count == 0) {
        const JsonObject anyShape(
            file, value, "an object",
            {"mesh", "sphere", "rectangle", "material", "scale", "rotate", "translate", "smooth", "instances", "priority"});
        throw Error(file.at(value), "an object has no shape", "add 'mesh', 'sphere' or 'rectangle'");
    }
    Object object;
    if (value.find("sphere")) {
        object = readSphere(file, value, scene);
    } else if (value.find("rectangle")) {
        object = readRectangle(file, value, scene);
    } else {
        object = readMeshObject(file, value, scene, meshes);
    }
    object.location = file.at(value);
    if (const JsonValue* priority = value.find("priority")) {
        const double number = readNumber(file, *priority, "priority", {-1000, 1000});
        if (number != std::floor(number)) throw Error(file.at(*priority), "'priority' is not whole", "give a whole number");
        object.priority = static_cast<int>(number);
    }
    return object;
}

void readObjects(SceneFile& file, const JsonObject& root, Scene& scene) {
    const JsonValue& objects = root.require("objects");
    requireType(file, objects, "'objects'", JsonType::array);
    if (objects.items.empty()) throw Error(file.at(objects), "there is nothing to render", "add an object to 'objects'");
    Paths meshes;
    std::map<std::string, int> numbers;
    for (const JsonValue& value : objects.items) {
        Object object = readObject(file, value, scene, meshes);
        if (object.shape != ShapeType::mesh) object.name += " " + std::to_string(++numbers[object.name]);
        scene.objects.push_back(std::move(object));
    }
    std::vector<char> wantMaterials(meshes.size(), 0);
    for (const Object& object : scene.objects)
        if (object.shape == ShapeType::mesh && object.material == kNone) wantMaterials[object.mesh] = 1;
    std::vector<std::filesystem::path> paths(meshes.size());
    for (const auto& [path, index] : meshes) paths[index] = path;
    for (size_t i = 0; i < paths.size(); ++i)
        scene.meshes.push_back(loadObj(paths[i], wantMaterials[i] != 0, scene, file.diagnostics));
}

void warnWhereBlack(const SceneFile& file, const Scene& scene) {
    const bool lit = !scene.lights.empty() || scene.background.image != kNone || scene.background.color != glm::vec3(0);
    const auto glows = [](const Material& m) { return m.emission != glm::vec3(0); };
    if (!lit && std::none_of(scene.materials.begin(), scene.materials.end(), glows))
        file.diagnostics.warn({file.path}, "the scene has no light",
                              "add 'lights' or a 'background', or the picture stays black");
}

}  // namespace

Scene loadScene(const std::filesystem::path& path, Diagnostics& diagnostics) {
    const JsonValue json = parseJson(readTextFile(path), path.string());
    SceneFile file{path.string(), path.parent_path(), diagnostics, {}};
    const JsonObject root(file, json, "the scene",
                          {"camera", "background", "lights", "materials", "objects", "nesting", "render"});
    Scene scene;
    scene.path = path.string();
    if (root.has("camera")) scene.camera = readCamera(file, *root.find("camera"));
    if (root.has("background")) scene.background = readBackground(file, *root.find("background"), scene);
    if (const JsonValue* lights = root.find("lights")) {
        requireType(file, *lights, "'lights'", JsonType::array);
        for (const JsonValue& light : lights->items) scene.lights.push_back(readLight(file, light));
    }
    if (root.has("materials")) readMaterials(file, *root.find("materials"), scene);
    scene.nesting = root.word("nesting", "ordered", {"ordered", "parity"}) == "parity" ? Nesting::parity : Nesting::ordered;
    if (root.has("render")) scene.render = readRender(file, *root.find("render"));
    readObjects(file, root, scene);
    if (scene.render.shadows != Shadows::byModel)
        for (Material& material : scene.materials) material.clearShadows = scene.render.shadows == Shadows::transmissive;
    warnWhereBlack(file, scene);
    return scene;
}

}  // namespace minirtc
