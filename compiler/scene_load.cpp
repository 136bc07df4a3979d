#include <algorithm>
#include <cmath>
#include <map>

#include "json_fields.hpp"
#include "levers.hpp"
#include "scene.hpp"
#include "scene_lights.hpp"
#include "scene_materials.hpp"
#include "scene_shapes.hpp"
#include "shining.hpp"
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
    if (object.has("image")) background.image = addImage(scene, object.file("image"), ColorSpace::srgb);
    return background;
}

const std::vector<std::string> kIntegrators = {"whitted", "path", "wavefront", "whitted_shared"};

Integrator integratorNamed(const std::string& name) {
    return static_cast<Integrator>(std::find(kIntegrators.begin(), kIntegrators.end(), name) - kIntegrators.begin());
}

/// 'integrators', and 'integrator', which is one of them.
void readIntegrators(const SceneFile& file, const JsonObject& object, RenderDefaults& render) {
    if (const JsonValue* list = object.find("integrators")) {
        requireType(file, *list, "'integrators'", JsonType::array);
        if (list->items.empty()) object.fail("integrators", "'integrators' is empty", "name one or leave it out");
        render.integrators.clear();
        render.integratorsGiven = true;
        for (const JsonValue& item : list->items) {
            requireType(file, item, "an integrator", JsonType::string);
            if (std::find(kIntegrators.begin(), kIntegrators.end(), item.string) == kIntegrators.end())
                throw Error(file.at(item), "there is no integrator " + inQuotes(item.string), suggest(item.string, kIntegrators));
            if (!render.uses(integratorNamed(item.string))) render.integrators.push_back(integratorNamed(item.string));
        }
        std::sort(render.integrators.begin(), render.integrators.end());
    }
    render.integrator = render.integrators[0];
    if (object.has("integrator")) render.integrator = integratorNamed(object.word("integrator", "", kIntegrators));
    const bool addsShared = render.integrator == Integrator::whittedShared && !render.integratorsGiven;
    if (addsShared) render.integrators.push_back(Integrator::whittedShared);
    if (!render.uses(render.integrator))
        object.fail("integrator", "'integrator' is none of 'integrators'", "add it there or name another one");
}

/// Settings of the accuracy levers that belong to baking.
LeverSettings readAccuracy(SceneFile& file, const JsonValue& value) {
    const JsonObject object(file, value, "the accuracy section", bakeLeverNames());
    LeverSettings settings;
    for (const JsonMember& member : value.members)
        settings[member.key] = object.word(member.key, "", settingNames(findLever(member.key)));
    return settings;
}

RenderDefaults readRender(SceneFile& file, const JsonValue& value) {
    const JsonObject object(
        file, value, "the render section",
        {"integrator", "integrators", "maxDepth", "spp", "size", "shadows", "dispersionMode", "filter", "accuracy"});
    RenderDefaults render;
    readIntegrators(file, object, render);
    if (const JsonValue* accuracy = object.find("accuracy")) render.accuracy = readAccuracy(file, *accuracy);
    const std::string filter = object.word("filter", "box", {"box", "tent", "gaussian"});
    render.filter = filter == "box" ? Filter::box : filter == "tent" ? Filter::tent : Filter::gaussian;
    const std::string shadows = object.word("shadows", "", {"transmissive", "opaque"});
    if (!shadows.empty()) render.shadows = shadows == "opaque" ? Shadows::opaque : Shadows::transmissive;
    const bool spectral = object.word("dispersionMode", "rgb", {"rgb", "spectral"}) == "spectral";
    render.dispersionMode = spectral ? DispersionMode::spectral : DispersionMode::rgb;
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
    sphere.sphere = readSphereShape(shape);
    sphere.material = readShapeMaterial(file, object, scene);
    const Material& material = scene.materials[sphere.material];
    const auto textured = [&](uint32_t m) { return m != kNone && isTextured(scene.materials[m]); };
    if (isTextured(material) || textured(material.checkerA) || textured(material.checkerB))
        object.fail("material", "a texture on a sphere is not in this version", "use a plain colour or a mesh");
    return sphere;
}

Object readRectangle(SceneFile& file, const JsonValue& value, const Scene& scene) {
    const JsonObject object(file, value, "a rectangle object", {"rectangle", "material", "priority"});
    const JsonObject shape(file, *object.find("rectangle"), "a rectangle", {"origin", "u", "v"});
    Object rectangle;
    rectangle.shape = ShapeType::rectangle;
    rectangle.name = "rectangle";
    rectangle.rectangle = readRectangleShape(shape, "the rectangle");
    rectangle.material = readShapeMaterial(file, object, scene);
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

/// What the scene asks for that its integrator does without.
void warnOfIdleKeys(const SceneFile& file, const Scene& scene, bool lightsWithSize) {
    const bool whitted = followsTrees(scene.render.integrator);
    if (!anythingShines(scene))
        file.diagnostics.warn({file.path}, "nothing shines", "add 'lights' or a 'background', or the picture stays black");
    else if (whitted && lightsWithSize && scene.lights.empty())
        file.diagnostics.warn({file.path}, "lights with size are seen by the integrator 'whitted', but light nothing",
                              "add a point, spot or directional light or \"integrator\": \"path\"");
    if (whitted && scene.camera.aperture > 0)
        file.diagnostics.warn({file.path}, "'aperture' has no effect with the integrator 'whitted'",
                              "add \"integrator\": \"path\"");
}

}  // namespace

Scene loadScene(const std::filesystem::path& path, Diagnostics& diagnostics) {
    const JsonValue json = parseJson(readTextFile(path), path.string());
    SceneFile file{path.string(), path.parent_path(), diagnostics};
    const JsonObject root(file, json, "the scene",
                          {"camera", "background", "lights", "materials", "objects", "nesting", "render"});
    Scene scene;
    scene.path = path.string();
    if (root.has("camera")) scene.camera = readCamera(file, *root.find("camera"));
    if (root.has("background")) scene.background = readBackground(file, *root.find("background"), scene);
    if (root.has("render")) scene.render = readRender(file, *root.find("render"));
    if (root.has("materials")) readMaterials(file, *root.find("materials"), scene);
    std::vector<Object> shining;
    if (root.has("lights")) shining = readLights(file, *root.find("lights"), scene);
    scene.nesting = root.word("nesting", "ordered", {"ordered", "parity"}) == "parity" ? Nesting::parity : Nesting::ordered;
    readObjects(file, root, scene);
    scene.objects.insert(scene.objects.end(), shining.begin(), shining.end());
    if (scene.render.shadows != Shadows::byModel)
        for (Material& material : scene.materials) material.clearShadows = scene.render.shadows == Shadows::transmissive;
    warnOfIdleKeys(file, scene, !shining.empty());
    return scene;
}

}  // namespace minirtc
