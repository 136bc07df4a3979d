#include "effect_scenes.hpp"

#include <algorithm>
#include <glm/glm.hpp>
#include <random>
#include <set>
#include <utility>

#include "image_text.hpp"
#include "scene_text.hpp"

using minirtc::Effect;

namespace test {
namespace {

std::string mesh(const std::string& file, const std::string& material, const std::string& members = "") {
    return R"({"mesh":")" + file + R"(","material":")" + material + R"(","scale":0.5,"translate":[@])" + members + "}";
}

std::string gem(const std::string& material) {
    return mesh("gem.obj", material);
}

std::string card(const std::string& material) {
    return mesh("card.obj", material);
}

bool hasEffect(const Parts& some, Effect effect) {
    return std::any_of(some.begin(), some.end(), [&](const Part& part) { return part.effect == effect; });
}

/// Where the parts of a scene stand, all of them in view.
constexpr glm::dvec3 kPlaces[] = {{-0.5, 0.6, 0.5}, {0.7, 0.6, 0.5},  {-1.1, 1.7, -0.5}, {0.1, 1.7, -0.5},
                                  {1.3, 1.7, -0.5}, {-1.7, 0.6, 0.5}, {1.9, 0.6, 0.5},   {-2.3, 1.7, -0.5}};
constexpr size_t kMostParts = 10;  // light needs no place
constexpr uint32_t kSeed = 11;     // of those tried, the one of fewest scenes

std::string placed(std::string objects, const glm::dvec3& place) {
    const std::string text = json(place.x) + "," + json(place.y) + "," + json(place.z);
    for (size_t at = objects.find('@'); at != std::string::npos; at = objects.find('@')) objects.replace(at, 1, text);
    return objects;
}

std::string lightsOf(const Parts& some) {
    std::string lights;
    for (const Part& part : some)
        if (!part.light.empty()) lights += (lights.empty() ? "" : ",") + part.light;
    return lights.empty() ? pointLight({2, 4, 3}, {20, 20, 20}, "inverse-square") : lights;
}

/// Path tracers pick a background that shines: an effect of its own.
std::string backgroundOf(const Parts& some, Tracer tracer) {
    if (hasEffect(some, Effect::backgroundImage)) return R"({"image":"paint.tga"})";
    const bool shines = tracer == Tracer::whitted || hasEffect(some, Effect::environmentLight);
    return shines ? R"({"color":[0.2,0.3,0.4]})" : "{}";
}

/// An octahedron about `center`, of which the first vertex has the number `first`.
std::string octahedron(const glm::dvec3& center, int first) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 p = center;
            p[axis] += sign;
            text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
        }
    for (int i = 0; i < 8; ++i) {
        int a = first + (i & 1), b = first + 2 + (i >> 1 & 1), c = first + 4 + (i >> 2 & 1);
        if (((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 == 0) std::swap(b, c);
        text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    }
    return text;
}

/// Indices of parts, the smaller first.
using Pair = std::pair<size_t, size_t>;

/// Of a tracer's pairs, those that one scene can hold.
std::set<Pair> openPairs(const Parts& some, Tracer tracer) {
    std::set<Pair> pairs;
    for (size_t b = 0; b < some.size(); ++b)
        for (size_t a = 0; a < b; ++a)
            if (tracerOf({some[a], some[b]}) == tracer && apart(some[a], some[b]).empty()) pairs.insert({a, b});
    return pairs;
}

bool hasRoom(const Parts& some, const std::vector<size_t>& group, const Part& further) {
    const auto stands = [&](size_t member) { return !some[member].objects.empty(); };
    const auto standing = static_cast<size_t>(std::count_if(group.begin(), group.end(), stands));
    return group.size() < kMostParts && (further.objects.empty() || standing < std::size(kPlaces));
}

/// How many open pairs a further part makes with those of a group; 0 if it cannot be beside one of them.
size_t gain(const Parts& some, const std::set<Pair>& open, const std::vector<size_t>& group, size_t further) {
    if (!hasRoom(some, group, some[further])) return 0;
    size_t count = 0;
    for (const size_t member : group) {
        if (member == further || !apart(some[member], some[further]).empty()) return 0;
        count += open.count(std::minmax(member, further));
    }
    return count;
}

/// An open pair, and again and again the part that makes most open pairs with those before.
std::vector<size_t> groupOf(const Parts& some, const std::set<Pair>& open) {
    std::vector<size_t> group = {open.begin()->first, open.begin()->second};
    while (true) {
        std::vector<size_t> gains;
        for (size_t i = 0; i < some.size(); ++i) gains.push_back(gain(some, open, group, i));
        const auto most = std::max_element(gains.begin(), gains.end());
        if (*most == 0) return group;
        group.push_back(static_cast<size_t>(most - gains.begin()));
    }
}

}  // namespace

const Parts& parts() {
    const std::string glass = R"({"model":"pbr","roughness":0,"transmission":1,"ior":1.5)";
    const std::string overlap = gem("outer") + "," + mesh("beside.obj", "inner", R"(,"priority":1)");
    const std::string two = R"("outer":)" + glass + R"(},"inner":)" + glass + R"(,"attenuationColor":[0.9,0.4,0.2]})";
    static const Parts all = {
        {Effect::triangles, "", ""},
        {Effect::spheres, R"("ball":{"model":"phong"})", R"({"sphere":{"center":[@],"radius":0.5},"material":"ball"})"},
        {Effect::smoothNormals, R"("round":{"model":"phong"})", mesh("gem.obj", "round", R"(,"smooth":true)")},
        {Effect::textures, R"("photo":{"model":"pbr","baseColor":"paint.tga"})", card("photo")},
        {Effect::checker, R"("a":{"model":"phong","diffuse":0.2},"board":{"model":"checker","a":"a","b":"floor","scale":0.25})",
         card("board")},
        {Effect::pointLights, "", "", pointLight({2, 4, 3}, {20, 20, 20}, "inverse-square")},
        {Effect::directionalLights, "", "", R"({"type":"directional","direction":[1,-2,-1]})"},
        {Effect::spotLights, "", "", R"({"type":"spot","position":[-1,3,2],"direction":[1,-2,-2],"intensity":[9,9,9]})"},
        {Effect::highlights, R"("shiny":{"model":"phong","specular":0.5,"shininess":5})", gem("shiny")},
        {Effect::reflection, R"("mirror":{"model":"phong","diffuse":0,"reflect":0.8})", gem("mirror")},
        {Effect::refraction, R"("clear":{"model":"phong","diffuse":0,"refract":0.8})", gem("clear")},
        {Effect::fresnel, R"("glass":)" + glass + "}", gem("glass")},
        {Effect::normalMaps, R"("bumpy":{"model":"pbr","normalTexture":"paint.tga"})", card("bumpy")},
        {Effect::emission, R"("glow":{"model":"pbr","emissive":[1,0.5,0.2]})", gem("glow")},
        {Effect::emissionMaps, R"("screen":{"model":"pbr","emissive":[1,1,1],"emissiveTexture":"paint.tga"})", card("screen")},
        {Effect::alpha, R"("leaf":{"model":"pbr","baseColor":"paint.tga","alphaMode":"mask"})", card("leaf")},
        {Effect::backgroundImage, "", ""},
        {Effect::thin, R"("sheet":)" + glass + R"(,"thin":true})", card("sheet")},
        {Effect::nesting, two, overlap},
        {Effect::parity, two, overlap, "", R"("nesting":"parity",)"},
        {Effect::selfOverlap, R"("gems":)" + glass + "}", mesh("gems.obj", "gems")},
        {Effect::absorption, R"("amber":)" + glass + R"(,"attenuationColor":[0.9,0.5,0.1]})", gem("amber")},
        {Effect::inscatter, R"("milk":)" + glass + R"(,"attenuationColor":[0.9,0.8,0.6],"inscatter":0.8})", gem("milk")},
        {Effect::dispersion, R"("flint":)" + glass + R"(,"dispersion":2})", gem("flint")},
        {Effect::spectral, R"("flint":)" + glass + R"(,"dispersion":2})", gem("flint")},
        {Effect::transmissiveShadows, R"("pane":)" + glass + "}", gem("pane")},
        {Effect::areaLights, R"("lamp":{"model":"pbr","emissive":[4,4,4]})", gem("lamp"), "", "", true},
        {Effect::environmentLight, "", "", "", "", true},
        {Effect::microfacets, R"("brass":{"model":"pbr","metallic":1,"roughness":0.4})", gem("brass"), "", "", true},
        {Effect::roughTransmission, R"("frost":{"model":"pbr","roughness":0.4,"transmission":1,"ior":1.5})", gem("frost"), "", "",
         true},
        {Effect::surfaceMaps, R"("worn":{"model":"pbr","metallic":1,"roughness":1,"metallicRoughnessTexture":"paint.tga"})",
         card("worn"), "", "", true},
        {Effect::lens, "", gem("floor"), "", "", true},
    };
    return all;
}

std::string namesOf(const Parts& some) {
    std::string names;
    for (const Part& part : some) names += std::string(effectInfo(part.effect).name) + " ";
    return names;
}

Tracer tracerOf(const Parts& some) {
    const bool path = std::any_of(some.begin(), some.end(), [](const Part& part) { return part.path; });
    return path ? Tracer::path : Tracer::whitted;
}

std::string apart(const Part& a, const Part& b) {
    const auto are = [&](Effect one, Effect other) { return std::minmax(a.effect, b.effect) == std::minmax(one, other); };
    if (are(Effect::nesting, Effect::parity)) return "volumes nest by their order or by parity";
    if (are(Effect::dispersion, Effect::spectral)) return "light disperses as red, green and blue or as wavelengths";
    return "";
}

std::vector<Parts> pairsOf(Tracer tracer) {
    std::vector<Parts> pairs;
    for (size_t b = 0; b < parts().size(); ++b)
        for (size_t a = 0; a < b; ++a)
            if (tracerOf({parts()[a], parts()[b]}) == tracer) pairs.push_back({parts()[a], parts()[b]});
    return pairs;
}

std::vector<Parts> groupsOfPairs(Tracer tracer) {
    Parts some = parts();
    std::shuffle(some.begin(), some.end(), std::mt19937(kSeed));
    std::vector<Parts> groups;
    for (std::set<Pair> open = openPairs(some, tracer); !open.empty();) {
        Parts& group = groups.emplace_back();
        const std::vector<size_t> members = groupOf(some, open);
        for (const size_t member : members) {
            group.push_back(some[member]);
            for (const size_t other : members) open.erase(std::minmax(member, other));
        }
    }
    return groups;
}

std::string sceneOf(const Parts& some, Tracer tracer) {
    std::string materials = R"("floor":{"model":"phong","diffuse":0.6})", objects, members;
    const glm::dvec3* place = kPlaces;
    for (const Part& part : some) {
        if (!part.material.empty()) materials += "," + part.material;
        if (!part.objects.empty()) objects += (objects.empty() ? "" : ",") + placed(part.objects, *place++);
        members += part.more;
    }
    const bool onlySpheres = some.size() == 1 && hasEffect(some, Effect::spheres);
    if (!onlySpheres) objects += (objects.empty() ? "" : ",") + floorOf("floor");
    const std::string aperture = hasEffect(some, Effect::lens) ? "0.1" : "0";
    const std::string integrator = tracer == Tracer::path ? "path" : "whitted";
    const std::string dispersion = hasEffect(some, Effect::spectral) ? "spectral" : "rgb";
    return "{" + members + R"("background":)" + backgroundOf(some, tracer) +
           R"(,"camera":{"position":[0.2,1.6,4.8],"target":[0.1,1,0],"vfov":38,"focusDistance":4.5,"aperture":)" + aperture +
           R"(},"render":{"size":[24,16],"maxDepth":6,"integrators":[")" + integrator + R"("],"dispersionMode":")" + dispersion +
           R"("},"lights":[)" + lightsOf(some) + R"(],"materials":{)" + materials + R"(},"objects":[)" + objects + "]}";
}

void writeFilesOfParts(const TemporaryDir& dir) {
    dir.write("gem.obj", octahedron({0, 0, 0}, 1));
    dir.write("gems.obj", octahedron({0, 0, 0}, 1) + octahedron({0.3, 0.2, 0.1}, 7));
    dir.write("beside.obj", octahedron({0.2, 0.6, 0.3}, 1));
    dir.write("card.obj",
              "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    dir.write("paint.tga", tga(4, 4, [](int x, int y) -> Rgba {
                  return {static_cast<unsigned char>(60 + 50 * x), static_cast<unsigned char>(200 - 40 * y),
                          static_cast<unsigned char>(120 + 30 * ((x + y) % 4)), static_cast<unsigned char>((x + y) % 2 * 255)};
              }));
}

}  // namespace test
