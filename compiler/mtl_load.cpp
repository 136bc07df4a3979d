#include "mtl_load.hpp"

#include <algorithm>
#include <cfloat>
#include <glm/gtc/constants.hpp>

#include "text_file.hpp"

#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

namespace minirtc {
namespace {

double readNumber(std::string_view word, const SourceLocation& at, const std::string& key) {
    const std::optional<double> number = parseFinite(word);
    if (!number) throw Error(at, inQuotes(word) + " after " + key + " is not a finite number", "repair the line");
    if (*number < 0 || *number > FLT_MAX)
        throw Error(at, inQuotes(word) + " after " + key + " is out of range", "give 0 or more");
    return *number;
}

double readScalar(std::string_view values, const SourceLocation& at, const std::string& key) {
    std::string_view word = takeValue(values);
    if (word == "-halo") word = takeValue(values);
    return readNumber(word, at, key);
}

/// Three numbers, or one for grey.
glm::dvec3 readColor(std::string_view values, const SourceLocation& at, const std::string& key) {
    glm::dvec3 color(readNumber(takeValue(values), at, key));
    std::string_view word = takeValue(values);
    if (word.empty()) return color;
    color.y = readNumber(word, at, key);
    color.z = readNumber(takeValue(values), at, key);
    return color;
}

int readIllum(std::string_view values, const SourceLocation& at) {
    return static_cast<int>(std::min(readScalar(values, at, "illum"), 1000.0));
}

void readMap(std::string_view values, const SourceLocation& at, MtlMaterial& material, Diagnostics& diagnostics) {
    tinyobj::texture_option_t options = {};
    std::fill(options.scale, options.scale + 3, 1.0);
    std::string name;
    if (!tinyobj::ParseTextureNameAndOption(&name, &options, std::string(values).c_str())) return;
    const auto zero = [](double x) { return x == 0; };
    const auto one = [](double x) { return x == 1; };
    if (!std::all_of(options.scale, options.scale + 3, one) ||
        !std::all_of(options.origin_offset, options.origin_offset + 3, zero))
        diagnostics.warn(at, "the -s and -o options of map_Kd have no effect in this version", "bake them into the vt lines");
    material.mapKd = std::string(trim(name));
    material.mapLocation = at;
}

void readKey(std::string_view key, std::string_view values, const SourceLocation& at, MtlMaterial& m, Diagnostics& diagnostics) {
    const std::string name(key);
    if (key == "Kd") m.Kd = readColor(values, at, name);
    if (key == "Ks") m.Ks = readColor(values, at, name);
    if (key == "Tf") m.Tf = readColor(values, at, name);
    if (key == "Ke") m.Ke = readColor(values, at, name);
    if (key == "Ns") m.Ns = readScalar(values, at, name);
    if (key == "Ni") m.Ni = readScalar(values, at, name);
    if (key == "Pr") m.Pr = std::min(readScalar(values, at, name), 1.0);
    if (key == "Pm") m.Pm = std::min(readScalar(values, at, name), 1.0);
    if (key == "d") m.d = std::min(readScalar(values, at, name), 1.0);
    if (key == "Tr" && !m.d) m.d = 1 - std::min(readScalar(values, at, name), 1.0);
    if (key == "illum") m.illum = readIllum(values, at);
    if (key == "map_Kd") readMap(values, at, m, diagnostics);
}

void addTexture(const MtlMaterial& mtl, Material& material, Scene& scene, Diagnostics& diagnostics) {
    const std::filesystem::path folder = std::filesystem::path(mtl.location.file).parent_path();
    const std::optional<std::filesystem::path> path = findBeside(folder, mtl.mapKd);
    if (!path) {
        diagnostics.warn(mtl.mapLocation, "there is no texture " + inQuotes(mtl.mapKd), "its colour Kd is used alone");
        return;
    }
    try {
        material.diffuseTexture = addImage(scene, *path);
    } catch (const Error& error) {
        diagnostics.warn(mtl.mapLocation, std::string(error.what()), "the colour Kd is used alone");
    }
}

/// Opacity: d where it is under 1; else 0 for the illumination models with refraction or glass.
double opacity(const MtlMaterial& mtl, int illum) {
    const double d = mtl.d.value_or(1.0);
    const bool glass = illum == 4 || illum == 6 || illum == 7 || illum == 9;
    return d < 1 ? d : glass ? 0 : 1;
}

}  // namespace

std::optional<std::filesystem::path> findBeside(const std::filesystem::path& folder, std::string name) {
    std::error_code code;
    const auto exists = [&](const std::filesystem::path& path) { return std::filesystem::is_regular_file(path, code); };
    if (exists(folder / name)) return (folder / name).lexically_normal();
    std::replace(name.begin(), name.end(), '\\', '/');
    if (exists(folder / name)) return (folder / name).lexically_normal();
    const std::filesystem::path last = folder / std::filesystem::path(name).filename();
    if (exists(last)) return last.lexically_normal();
    return std::nullopt;
}

std::vector<MtlMaterial> readMtl(const std::filesystem::path& path, Diagnostics& diagnostics) {
    const std::string text = readTextFile(path);
    std::vector<MtlMaterial> materials;
    for (LineReader lines(text); lines.next();) {
        std::string_view values = lines.line();
        const std::string_view key = takeWord(values);
        const SourceLocation at{path.string(), lines.number()};
        if (key == "newmtl") {
            materials.emplace_back();
            materials.back().name = std::string(trim(values));
            materials.back().location = at;
        } else if (!materials.empty()) {
            readKey(key, values, at, materials.back(), diagnostics);
        }
    }
    return materials;
}

Material toMaterial(const MtlMaterial& mtl, Scene& scene, Diagnostics& diagnostics) {
    const int illum = mtl.illum.value_or(2);
    const bool pbr = mtl.Pr || mtl.Pm;
    const double metallic = mtl.Pm.value_or(0.0);
    if (metallic > 0 && mtl.Pr.value_or(0.5) > 0)
        throw Error(mtl.location, "the material " + inQuotes(mtl.name) + " is a metal with roughness over 0: not in this version",
                    "set Pr to 0 or name another material in the scene file");
    const float a = static_cast<float>(opacity(mtl, illum));
    const glm::vec3 kd(mtl.Kd.value_or(glm::dvec3(mtl.mapKd.empty() ? 0.5 : 1.0)));
    const glm::vec3 ks(mtl.Ks.value_or(glm::dvec3(0)));
    const glm::vec3 filter(mtl.Tf && *mtl.Tf != glm::dvec3(0) ? *mtl.Tf : glm::dvec3(1));

    Material material;
    material.name = mtl.name;
    material.diffuse = kd * a;
    if (pbr) material.diffuse *= static_cast<float>(1 - metallic) * glm::one_over_pi<float>();
    if (!pbr && illum >= 2) material.specular = ks;
    material.shininess = static_cast<float>(std::max(mtl.Ns.value_or(1.0), 1.0));
    if (pbr) material.reflect = kd * static_cast<float>(metallic);
    if (!pbr && illum >= 3 && illum <= 7) material.reflect = ks;
    material.transmit = filter * (1 - a);
    material.fresnel = !pbr && (illum == 5 || illum == 7);
    const double ior = mtl.Ni.value_or(1.0);
    material.ior = ior >= FLT_MIN ? static_cast<float>(ior) : 1.0f;
    material.emission = glm::vec3(mtl.Ke.value_or(glm::dvec3(0)));
    if (!mtl.mapKd.empty()) addTexture(mtl, material, scene, diagnostics);
    return material;
}

}  // namespace minirtc
