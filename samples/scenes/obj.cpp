#include <cstdio>

#include "mesh.hpp"
#include "output.hpp"

namespace samples {
namespace {

/// Digits enough for a micrometre on a metre; "-0" becomes "0".
std::string number(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    std::string s = text;
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s == "-0" ? "0" : s;
}

void appendRow(std::string& text, const char* keyword, const double* values, int count, int decimals) {
    text += keyword;
    for (int i = 0; i < count; ++i) text += " " + number(values[i], decimals);
    text += "\n";
}

std::string cornerText(const Corner& corner) {
    std::string text = std::to_string(corner.position + 1);
    if (corner.uv != kNone || corner.normal != kNone) text += "/";
    if (corner.uv != kNone) text += std::to_string(corner.uv + 1);
    if (corner.normal != kNone) text += "/" + std::to_string(corner.normal + 1);
    return text;
}

}  // namespace

void writeObj(const Mesh& mesh, const std::filesystem::path& path, const std::string& material) {
    std::string text;
    if (!material.empty()) text += "mtllib " + material + ".mtl\nusemtl " + material + "\n";
    for (const glm::dvec3& p : mesh.positions) appendRow(text, "v", &p.x, 3, 7);
    for (const glm::dvec2& uv : mesh.uvs) appendRow(text, "vt", &uv.x, 2, 5);
    for (const glm::dvec3& n : mesh.normals) appendRow(text, "vn", &n.x, 3, 5);
    for (const Face& face : mesh.faces) {
        text += "f";
        for (const Corner& corner : face) text += " " + cornerText(corner);
        text += "\n";
    }
    writeText(path, text);
}

}  // namespace samples
