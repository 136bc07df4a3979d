#include "mtl_load.hpp"

#include <algorithm>
#include <cfloat>
#include <glm/gtc/constants.hpp>
#include <map>

#include "text_file.hpp"

namespace minirtc {
namespace {

/// `count` numbers, or one for all of them.
void rewriteNumbers(std::string_view key, std::string_view values, int count, const SourceLocation& at, std::string& out) {
    std::string_view word = takeValue(values), rest = values;
    if (key == "d" && word == "-halo") word = takeValue(values), rest = values;
    const bool grey = takeValue(rest).empty();
    out += key;
    for (int i = 0; i < count; ++i, word = grey ? word : takeValue(values)) {
        const std::optional<double> number = appendNumber(out, word);
        const std::string what = inQuotes(word) + " after " + std::string(key);
        if (!number) throw Error(at, what + " is not a finite number", "repair the line");
        if (*number < 0 || *number > FLT_MAX) throw Error(at, what + " is out of range", "give 0 or more");
    }
}

/// A line as tinyobjloader needs it, which takes 0 for what it cannot read or does not find and loses materials without a name.
/// Only the keys that count are passed on; a newmtl becomes a material.
void rewriteLine(std::string_view line, const SourceLocation& at, std::vector<MtlMaterial>& materials, std::string& out) {
    const std::string_view key = takeWord(line);
    const auto is = [&](const auto&... keys) { return ((key == keys) || ...); };
    if (is("newmtl")) {
        materials.push_back({std::string(trim(line)), {}, at, {}});
        out += "newmtl m\nillum 2\nKd -1 -1 -1\nPr -1\nPm -1";
    } else if (materials.empty()) {
        return;
    } else if (is("Kd", "Ks", "Tf", "Ke")) {
        rewriteNumbers(key, line, 3, at, out);
    } else if (is("Ns", "Ni", "Pr", "Pm", "d", "Tr", "illum")) {
        rewriteNumbers(key, line, 1, at, out);
    } else if (is("map_Kd")) {
        materials.back().mapLocation = at;
        out.append("map_Kd ").append(trim(line));
    }
}

glm::dvec3 toVector(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

void addTexture(const MtlMaterial& mtl, Material& material, Scene& scene, Diagnostics& diagnostics) {
    const tinyobj::texture_option_t& options = mtl.values.diffuse_texopt;
    if (toVector(options.scale) != glm::dvec3(1) || toVector(options.origin_offset) != glm::dvec3(0))
        diagnostics.warn(mtl.mapLocation, "the -s and -o options of map_Kd have no effect in this version",
                         "bake them into the vt lines");
    const std::string& name = mtl.values.diffuse_texname;
    const std::filesystem::path folder = std::filesystem::path(mtl.location.file).parent_path();
    const std::optional<std::filesystem::path> path = findBeside(folder, name);
    if (!path) {
        diagnostics.warn(mtl.mapLocation, "there is no texture " + inQuotes(name), "its colour Kd is used alone");
        return;
    }
    try {
        material.diffuseTexture = addImage(scene, *path, ColorSpace::srgb);
    } catch (const Error& error) {
        diagnostics.warn(mtl.mapLocation, std::string(error.what()), "the colour Kd is used alone");
    }
}

/// Opacity: d where it is under 1; else 0 for the illumination models with refraction or glass.
double opacity(const tinyobj::material_t& m) {
    const bool glass = m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9;
    return m.dissolve < 1 ? std::max(m.dissolve, 0.0) : glass ? 0 : 1;
}

/// What shows through is smooth: roughness is that of opaque surfaces.
Physical toPhysical(const tinyobj::material_t& m, const glm::vec3& kd, double metallic, float opacity) {
    constexpr double kUsual = 0.5;
    const double roughness = opacity < 1 ? 0 : m.roughness < 0 ? kUsual : std::min(m.roughness, 1.0);
    return {kd, static_cast<float>(metallic), static_cast<float>(roughness), 1 - opacity};
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

std::vector<MtlMaterial> readMtl(const std::filesystem::path& path) {
    const std::string text = readTextFile(path);
    std::vector<MtlMaterial> materials;
    RewrittenLines lines(text, [&](std::string_view line, std::string& out) {
        rewriteLine(line, {path.string(), lines.number()}, materials, out);
    });
    std::map<std::string, int> indices;
    std::vector<tinyobj::material_t> values;  // one even where the file has none
    tinyobj::LoadMtl(&indices, &values, &lines, nullptr, nullptr);
    for (size_t i = 0; i < materials.size(); ++i) materials[i].values = std::move(values[i]);
    return materials;
}

Material toMaterial(const MtlMaterial& mtl, Scene& scene, Diagnostics& diagnostics) {
    const tinyobj::material_t& m = mtl.values;
    const bool pbr = m.roughness >= 0 || m.metallic >= 0, textured = !m.diffuse_texname.empty();
    const double metallic = std::clamp(m.metallic, 0.0, 1.0);
    if (metallic > 0 && m.roughness != 0)
        leaveWhittedOut(scene, mtl.location, "the metal " + inQuotes(mtl.name) + " with roughness over 0",
                        "set Pr to 0 or name another material in the scene file");
    const float a = static_cast<float>(opacity(m));
    const glm::vec3 kd = m.diffuse[0] < 0 ? glm::vec3(textured ? 1.0f : 0.5f) : glm::vec3(toVector(m.diffuse));
    const glm::vec3 ks(toVector(m.specular)), filter(toVector(m.transmittance));

    Material material;
    material.name = mtl.name;
    material.diffuse = kd * a;
    if (pbr) material.diffuse *= static_cast<float>(1 - metallic) * glm::one_over_pi<float>();
    if (!pbr && m.illum >= 2) material.specular = ks;
    material.shininess = static_cast<float>(std::max(m.shininess, 1.0));
    if (pbr) material.reflect = kd * static_cast<float>(metallic);
    if (!pbr && m.illum >= 3 && m.illum <= 7) material.reflect = ks;
    material.transmit = (filter == glm::vec3(0) ? glm::vec3(1) : filter) * (1 - a);
    material.fresnel = !pbr && (m.illum == 5 || m.illum == 7);
    material.ior = m.ior >= FLT_MIN ? static_cast<float>(m.ior) : 1.0f;
    material.thin = material.ior == 1.0f;  // bends nothing: a way to write how much of a sheet is there
    material.emission = glm::vec3(toVector(m.emission));
    if (pbr) material.physical = toPhysical(m, kd, metallic, a);
    if (textured) addTexture(mtl, material, scene, diagnostics);
    return material;
}

}  // namespace minirtc
