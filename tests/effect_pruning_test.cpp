// What minirtc leaves out of a kernel is not missed, and what it puts in is needed: scenes that call for each effect, alone and beside others.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "image_text.hpp"
#include "render_scene.hpp"
#include "scene_text.hpp"

using namespace minirtc;
using namespace test;

namespace {

/// What calls for an effect. In `objects`, @ stands for the x of its place.
struct Part {
    Effect effect;
    std::string material;  // "name": {...}
    std::string objects;
    std::string light = "";
    std::string more = "";  // members of the scene
    bool path = false;      // needs the path tracer
};

std::string gem(const std::string& material, double scale = 0.5) {
    return R"({"mesh":"gem.obj","material":")" + material + R"(","scale":)" + json(scale) + R"(,"translate":[@,0.6,0]})";
}

std::string card(const std::string& material) {
    return R"({"mesh":"card.obj","material":")" + material + R"(","scale":0.5,"translate":[@,0.6,0.2]})";
}

const std::vector<Part>& parts() {
    const std::string glass = R"({"model":"pbr","roughness":0,"transmission":1,"ior":1.5)";
    const std::string overlap = gem("outer") + R"(,{"mesh":"gem.obj","material":"inner","scale":0.4,"translate":[@,0.9,0.1]})";
    const std::string two = R"("outer":)" + glass + R"(},"inner":)" + glass + R"(,"attenuationColor":[0.9,0.4,0.2]})";
    static const std::vector<Part> all = {
        {Effect::spheres, R"("ball":{"model":"phong"})", R"({"sphere":{"center":[@,0.6,0],"radius":0.5},"material":"ball"})"},
        {Effect::smoothNormals, R"("round":{"model":"phong"})",
         R"({"mesh":"gem.obj","material":"round","smooth":true,"scale":0.5,"translate":[@,0.6,0]})"},
        {Effect::textures, R"("photo":{"model":"pbr","baseColor":"paint.tga"})", card("photo")},
        {Effect::checker, R"("a":{"model":"phong","diffuse":0.2},"board":{"model":"checker","a":"a","b":"floor","scale":0.25})",
         card("board")},
        {Effect::pointLights, "", gem("floor")},
        {Effect::directionalLights, "", gem("floor"), R"({"type":"directional","direction":[1,-2,-1]})"},
        {Effect::spotLights, "", gem("floor"), R"({"type":"spot","position":[-1,3,2],"direction":[1,-2,-2]})"},
        {Effect::highlights, R"("shiny":{"model":"phong","specular":0.5,"shininess":5})", gem("shiny")},
        {Effect::reflection, R"("mirror":{"model":"phong","diffuse":0,"reflect":0.8})", gem("mirror")},
        {Effect::refraction, R"("clear":{"model":"phong","diffuse":0,"refract":0.8})", gem("clear")},
        {Effect::fresnel, R"("glass":)" + glass + "}", gem("glass")},
        {Effect::normalMaps, R"("bumpy":{"model":"pbr","normalTexture":"paint.tga"})", card("bumpy")},
        {Effect::emission, R"("glow":{"model":"pbr","emissive":[1,0.5,0.2]})", gem("glow")},
        {Effect::emissionMaps, R"("screen":{"model":"pbr","emissive":[1,1,1],"emissiveTexture":"paint.tga"})", card("screen")},
        {Effect::alpha, R"("leaf":{"model":"pbr","baseColor":"paint.tga","alphaMode":"mask"})", card("leaf")},
        {Effect::backgroundImage, "", gem("floor"), "", R"("background":{"image":"paint.tga"})"},
        {Effect::thin, R"("sheet":)" + glass + R"(,"thin":true})", card("sheet")},
        {Effect::nesting, two, overlap},
        {Effect::parity, two, overlap, "", R"("nesting":"parity")"},
        {Effect::selfOverlap, R"("gems":)" + glass + "}",
         R"({"mesh":"gems.obj","material":"gems","scale":0.5,"translate":[@,0.6,0]})"},
        {Effect::absorption, R"("amber":)" + glass + R"(,"attenuationColor":[0.9,0.5,0.1]})", gem("amber")},
        {Effect::inscatter, R"("milk":)" + glass + R"(,"attenuationColor":[0.9,0.8,0.6],"inscatter":0.8})", gem("milk")},
        {Effect::dispersion, R"("flint":)" + glass + R"(,"dispersion":2})", gem("flint")},
        {Effect::spectral, R"("flint":)" + glass + R"(,"dispersion":2})", gem("flint"), "", R"("spectral")"},
        {Effect::transmissiveShadows, R"("pane":)" + glass + "}", gem("pane")},
        {Effect::areaLights, R"("lamp":{"model":"pbr","emissive":[4,4,4]})", gem("lamp"), "", "", true},
        {Effect::environmentLight, "", gem("floor"), "", "", true},
        {Effect::microfacets, R"("brass":{"model":"pbr","metallic":1,"roughness":0.4})", gem("brass"), "", "", true},
        {Effect::roughTransmission, R"("frost":{"model":"pbr","roughness":0.4,"transmission":1,"ior":1.5})", gem("frost"), "", "",
         true},
        {Effect::surfaceMaps, R"("worn":{"model":"pbr","metallic":1,"roughness":1,"metallicRoughnessTexture":"paint.tga"})",
         card("worn"), "", "", true},
        {Effect::lens, "", gem("floor"), "", R"("aperture")", true},
    };
    return all;
}

std::string placed(std::string objects, double x) {
    for (size_t at = objects.find('@'); at != std::string::npos; at = objects.find('@')) objects.replace(at, 1, json(x));
    return objects;
}

/// Where the parts of a scene stand.
constexpr double kPlaces[] = {0, -1, 1};
constexpr size_t kMostParts = 3;

/// A floor under a lamp with some parts side by side.
std::string sceneOf(const std::vector<Part>& some) {
    std::string materials = R"("floor":{"model":"phong","diffuse":0.6})";
    std::string objects = floorOf("floor");
    std::string lights = pointLight({2, 4, 3}, {20, 20, 20}, "inverse-square");
    std::string members;
    bool path = false, spectral = false, aperture = false, background = false;
    for (size_t i = 0; i < some.size(); ++i) {
        const Part& part = some[i];
        if (!part.material.empty()) materials += "," + part.material;
        objects += "," + placed(part.objects, kPlaces[i]);
        if (!part.light.empty()) lights += "," + part.light;
        path |= part.path;
        spectral |= part.more == "\"spectral\"";
        aperture |= part.more == "\"aperture\"";
        background |= part.effect == Effect::backgroundImage;
        if (!part.more.empty() && part.more.find(':') != std::string::npos) members += part.more + ",";
    }
    if (!background) members += R"("background":{"color":[0.2,0.3,0.4]},)";
    const std::string integrator = path ? "path" : "whitted";
    return "{" + members + R"("camera":{"position":[0.2,1.3,3.5],"target":[0,0.5,0],"vfov":40,"focusDistance":2,"aperture":)" +
           (aperture ? "0.3" : "0") + R"(},"render":{"size":[16,16],"maxDepth":6,"integrators":[")" + integrator +
           R"("],"dispersionMode":")" + (spectral ? "spectral" : "rgb") + R"("},"lights":[)" + lights + R"(],"materials":{)" +
           materials + R"(},"objects":[)" + objects + "]}";
}

std::string namesOf(const std::vector<Part>& some) {
    std::string names;
    for (const Part& part : some) names += std::string(effectInfo(part.effect).name) + " ";
    return names;
}

/// Two octahedra in one mesh, or one, and a card with texture coordinates, with a picture of all values and alphas.
void writeFiles(const TemporaryDir& dir) {
    const auto octahedron = [](double x, int first) {
        std::string text;
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                glm::dvec3 p(x, 0, 0);
                p[axis] += sign;
                text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
            }
        for (int i = 0; i < 8; ++i) {
            int a = first + (i & 1), b = first + 2 + (i >> 1 & 1), c = first + 4 + (i >> 2 & 1);
            if (((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 == 0) std::swap(b, c);
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
        }
        return text;
    };
    dir.write("gem.obj", octahedron(0, 1));
    dir.write("gems.obj", octahedron(0, 1) + octahedron(0.5, 7));
    dir.write("card.obj",
              "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    dir.write("paint.tga", tga(4, 4, [](int x, int y) -> Rgba {
                  return {static_cast<unsigned char>(60 + 50 * x), static_cast<unsigned char>(200 - 40 * y),
                          static_cast<unsigned char>(120 + 30 * ((x + y) % 4)), static_cast<unsigned char>((x + y) % 2 * 255)};
              }));
}

BakeOptions with(const std::vector<std::string>& without) {
    BakeOptions options;
    options.choices.without = without;
    options.choices.force = !without.empty();
    return options;
}

BakeOptions withAll() {
    BakeOptions options;
    options.choices.allEffects = true;
    return options;
}

/// The one kernel of a blob.
std::vector<uint32_t> spirvOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
    minirt_blob blob;
    REQUIRE(minirt_validate(bytes.data(), bytes.size(), &blob, nullptr) == MINIRT_OK);
    REQUIRE(blob.kernel_count == 1);
    std::vector<uint32_t> words(blob.kernels[0].spirv_size / 4);
    std::memcpy(words.data(), blob.spirv + blob.kernels[0].spirv_offset, words.size() * 4);
    return words;
}

/// Numbers that OpDecorate gives as a Binding.
std::set<uint32_t> bindingsOf(const std::vector<uint32_t>& spirv) {
    constexpr uint32_t kOpDecorate = 71, kBinding = 33;
    std::set<uint32_t> bindings;
    for (size_t i = 5; i < spirv.size() && spirv[i] >> 16; i += spirv[i] >> 16)
        if ((spirv[i] & 0xffffu) == kOpDecorate && spirv[i + 2] == kBinding) bindings.insert(spirv[i + 3]);
    return bindings;
}

/// Whether a kernel with these effects may read a buffer.
bool mayRead(const EffectSet& effects, uint32_t binding) {
    const auto any = [&](std::initializer_list<Effect> readers) {
        return std::any_of(readers.begin(), readers.end(), [&](Effect effect) { return effects.has(effect); });
    };
    const bool uvs = any({Effect::textures, Effect::alpha, Effect::surfaceMaps, Effect::normalMaps, Effect::emissionMaps});
    const bool lights = any({Effect::pointLights, Effect::directionalLights, Effect::spotLights});
    switch (binding) {
        case MINIRT_BINDING_NORMALS:
            return any({Effect::smoothNormals});
        case MINIRT_BINDING_UVS:
            return uvs;
        case MINIRT_BINDING_IMAGES:
        case MINIRT_BINDING_TEXELS:
            return uvs || any({Effect::backgroundImage});
        case MINIRT_BINDING_LIGHTS:
            return lights;
        case MINIRT_BINDING_MEDIA:
            return any({Effect::nesting, Effect::absorption, Effect::inscatter, Effect::dispersion});
        case MINIRT_BINDING_SPECTRUM:
            return any({Effect::spectral});
        case MINIRT_BINDING_EMITTERS:
            return lights || any({Effect::areaLights, Effect::environmentLight});
        case MINIRT_BINDING_ENVIRONMENT:
            return any({Effect::environmentLight});
        default:
            return true;
    }
}

void checkReadsWhatItNeeds(const std::filesystem::path& blob, const EffectSet& effects) {
    for (const uint32_t binding : bindingsOf(spirvOf(blob))) {
        CAPTURE(binding);
        CHECK(mayRead(effects, binding));
    }
}

EffectSet calledFor(const std::filesystem::path& scene, const std::vector<Part>& some) {
    Diagnostics diagnostics;
    const EffectSet effects = factsOf(scene.string(), diagnostics).effects;
    for (const Part& part : some) CHECK(effects.has(part.effect));
    return effects;
}

/// Whether one scene can hold both: they are for one integrator and differ in their material.
bool together(const Part& a, const Part& b) {
    return a.path == b.path && (a.material.empty() || a.material != b.material);
}

/// All parts in as few scenes as hold them, whose neighbours are drawn once and for all.
std::vector<std::vector<Part>> mixedParts() {
    std::vector<Part> shuffled = parts();
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
    std::vector<std::vector<Part>> groups;
    for (const Part& part : shuffled) {
        const auto fits = [&](const std::vector<Part>& group) {
            return group.size() < kMostParts &&
                   std::all_of(group.begin(), group.end(), [&](const Part& other) { return together(part, other); });
        };
        const auto group = std::find_if(groups.begin(), groups.end(), fits);
        if (group == groups.end())
            groups.push_back({part});
        else
            group->push_back(part);
    }
    return groups;
}

/// Of pixels, the share with a channel that differs by more than a thousandth; and how much channels differ in the mean.
struct Difference {
    double share = 0, mean = 0;
};

Difference differenceOf(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    Difference difference;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        bool alike = true;
        for (size_t k = i; k < i + 4; ++k) {
            const float apart = std::abs(a.rgba[k] - b.rgba[k]) / (1 + std::abs(b.rgba[k]));
            alike &= apart <= 1e-3f;  // not so of NaN
            difference.mean += static_cast<double>(apart) / static_cast<double>(a.rgba.size());
        }
        difference.share += alike ? 0 : 4.0 / static_cast<double>(a.rgba.size());
    }
    return difference;
}

/// The same bits on a processor. A GPU's compiler rounds other code otherwise, and a path that then takes another way is another sample of its pixel: on
/// an H100 some bits differed, and no pixel by more than a thousandth.
void checkSame(const GpuContext& gpu, const Picture& pruned, const Picture& full) {
    if (gpu.isCpu()) {
        CHECK(pruned == full);
        return;
    }
    const Difference difference = differenceOf(pruned, full);
    if (difference.share > 0) MESSAGE(100 * difference.share, " % of the pixels differ by more than rounding");
    CHECK(difference.share <= 0.005);
    CHECK(difference.mean <= 5e-4);
}

}  // namespace

TEST_CASE("an effect that a scene calls for is seen where it is missing, and brings no more buffers than it reads") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    writeFiles(dir);
    for (const Part& part : parts()) {
        CAPTURE(namesOf({part}));
        const auto pruned = bakeScene(dir, sceneOf({part}), "pruned", with({}));
        checkReadsWhatItNeeds(pruned, calledFor(dir.path() / "pruned.json", {part}));
        const auto lacking = bakeScene(dir, sceneOf({part}), "lacking", with({effectInfo(part.effect).name}));
        CHECK_FALSE(LoadedScene(gpu, lacking).render() == LoadedScene(gpu, pruned).render());
    }
}

TEST_CASE("a kernel with what the scene calls for is smaller than one with every effect and draws the same bits") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    writeFiles(dir);
    for (const std::vector<Part>& group : mixedParts()) {
        CAPTURE(namesOf(group));
        const auto pruned = bakeScene(dir, sceneOf(group), "pruned", with({}));
        const auto full = bakeScene(dir, sceneOf(group), "full", withAll());
        checkReadsWhatItNeeds(pruned, calledFor(dir.path() / "pruned.json", group));
        CHECK(spirvOf(pruned).size() < spirvOf(full).size());
        checkSame(gpu, LoadedScene(gpu, pruned).render(), LoadedScene(gpu, full).render());
    }
}
