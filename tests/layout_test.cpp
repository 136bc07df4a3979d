#include <doctest/doctest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>

#include "glsl.hpp"
#include "kernel.hpp"
#include "minirt.h"
#include "shader_library.hpp"

using namespace minirtc;

namespace {

struct Layout {
    size_t size = 0;
    std::map<std::string, size_t> offsets;
    bool operator==(const Layout& other) const { return size == other.size && offsets == other.offsets; }
};

std::ostream& operator<<(std::ostream& out, const Layout& layout) {
    for (const auto& [member, offset] : layout.offsets) out << member << " at " << offset << ", ";
    return out << "size " << layout.size;
}

/// Where kernels hold a struct as a whole.
const std::map<std::string, std::string> kVariables = {
    {"minirt_scene_rows", "scene"}, {"minirt_frame", "frame"}, {"minirt_counters", "counters"}};

/// Rows of 16 bytes of the structs that kernels fetch row by row.
const std::map<std::string, size_t> kRows = {{"minirt_material", MINIRT_MATERIAL_ROWS},
                                             {"minirt_light", MINIRT_LIGHT_ROWS},
                                             {"minirt_image", MINIRT_IMAGE_ROWS},
                                             {"minirt_medium", MINIRT_MEDIUM_ROWS},
                                             {"minirt_pick", MINIRT_PICK_ROWS}};

#define AT(type, member) \
    { #member, offsetof(type, member) }

/// Each struct of the slice as C++ lays it out.
const std::map<std::string, Layout> kInCpp = {
    {"minirt_scene_rows",
     {sizeof(minirt_scene_rows),
      {AT(minirt_scene_rows, gridOrigin), AT(minirt_scene_rows, gridScale), AT(minirt_scene_rows, gridPlanes),
       AT(minirt_scene_rows, background), AT(minirt_scene_rows, boundsMin), AT(minirt_scene_rows, boundsMax),
       AT(minirt_scene_rows, counts), AT(minirt_scene_rows, environment)}}},
    {"minirt_material",
     {sizeof(minirt_material),
      {AT(minirt_material, diffuse), AT(minirt_material, specular), AT(minirt_material, reflect), AT(minirt_material, transmit),
       AT(minirt_material, emission), AT(minirt_material, checker), AT(minirt_material, options), AT(minirt_material, base),
       AT(minirt_material, finish), AT(minirt_material, images)}}},
    {"minirt_light",
     {sizeof(minirt_light),
      {AT(minirt_light, position), AT(minirt_light, intensity), AT(minirt_light, axis), AT(minirt_light, options)}}},
    {"minirt_image", {sizeof(minirt_image), {AT(minirt_image, extent), AT(minirt_image, scale)}}},
    {"minirt_medium",
     {sizeof(minirt_medium),
      {AT(minirt_medium, absorption), AT(minirt_medium, ior), AT(minirt_medium, iorCurve), AT(minirt_medium, iorCurveEnd),
       AT(minirt_medium, boundsMin), AT(minirt_medium, boundsMax)}}},
    {"minirt_pick", {sizeof(minirt_pick), {AT(minirt_pick, entry)}}},
    {"minirt_frame",
     {sizeof(minirt_frame),
      {AT(minirt_frame, position), AT(minirt_frame, forward), AT(minirt_frame, right), AT(minirt_frame, up),
       AT(minirt_frame, size), AT(minirt_frame, region), AT(minirt_frame, blocks), AT(minirt_frame, sampling)}}},
    {"minirt_counters",
     {sizeof(minirt_counters),
      {AT(minirt_counters, pending), AT(minirt_counters, nan_pixels), AT(minirt_counters, segment_overflow),
       AT(minirt_counters, unfinished), AT(minirt_counters, volume_overflow), AT(minirt_counters, reserved0),
       AT(minirt_counters, reserved1), AT(minirt_counters, reserved2)}}},
};

/// The structs of the slice by their text, with their members.
std::map<std::string, std::set<std::string>> structsOfSlice() {
    std::map<std::string, std::set<std::string>> structs;
    std::istringstream lines(shaderLibrary().at("layout"));
    std::string current;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first;
        std::string second;
        words >> first >> second;
        if (first == "struct") current = second;
        if (first == "};") current.clear();
        const size_t semicolon = second.find(';');
        if (!current.empty() && semicolon != std::string::npos) structs[current].insert(second.substr(0, semicolon));
    }
    return structs;
}

/// The kernel with a buffer `probe_STRUCT` for each struct of kRows: reflection shows structs only where a buffer holds them.
std::string withProbes(std::string kernel) {
    std::string buffers;
    std::string uses;
    int binding = MINIRT_BINDING_COUNT;
    for (const auto& entry : kRows) {
        const std::string& name = entry.first;
        buffers += "layout(std430, binding = " + std::to_string(binding++) + ") readonly buffer Block_" + name + " { " + name +
                   " probe_" + name + "[]; };\n";
        uses += name + " first_" + name + " = probe_" + name + "[0];\n";
    }
    const std::string start = "void main() {\n";
    const size_t at = kernel.find(start);
    REQUIRE(at != std::string::npos);
    return kernel.replace(at, start.size(), buffers + start + uses);
}

/// Each variable of a shared struct as the kernel with every effect lays it out.
std::map<std::string, Layout> reflectKernel() {
    EffectSet effects;
    includeAll(effects);
    const test::ParsedGlsl glsl = test::parseGlsl(withProbes(composeKernel("whitted", effects)));
    REQUIRE_MESSAGE(glsl.parsed, glsl.shader->getInfoLog());
    glslang::TProgram program;
    program.addShader(glsl.shader.get());
    REQUIRE(program.link(test::kGlslMessages));
    REQUIRE(program.buildReflection(EShReflectionAllBlockVariables));

    std::map<std::string, Layout> layouts;
    for (int i = 0; i < program.getNumUniformVariables(); ++i) {
        const glslang::TObjectReflection& variable = program.getUniform(i);
        const size_t dot = variable.name.find('.');
        if (dot == std::string::npos) continue;
        Layout& layout = layouts[variable.name.substr(0, dot)];
        layout.offsets[variable.name.substr(dot + 1)] = static_cast<size_t>(variable.offset);
        layout.size = static_cast<size_t>(program.getUniformBlock(variable.index).size);  // of an array: one element
    }
    return layouts;
}

}  // namespace

TEST_CASE("the kernel lays out every shared struct as C++ does") {
    const std::map<std::string, Layout> reflected = reflectKernel();
    for (const auto& [name, layout] : kInCpp) {
        CAPTURE(name);
        const std::string variable = kVariables.count(name) ? kVariables.at(name) : "probe_" + name;
        REQUIRE(reflected.count(variable) == 1);
        CHECK(reflected.at(variable) == layout);
    }
}

TEST_CASE("structs that are fetched by row have a row a member") {
    for (const auto& [name, rows] : kRows) {
        CAPTURE(name);
        CHECK(kInCpp.at(name).size == rows * 16);
        CHECK(kInCpp.at(name).offsets.size() == rows);
    }
}

TEST_CASE("this test knows every struct of the shared slice with all members") {
    std::map<std::string, std::set<std::string>> known;
    for (const auto& [name, layout] : kInCpp) {
        for (const auto& member : layout.offsets) known[name].insert(member.first);
    }
    CHECK(structsOfSlice() == known);
}

TEST_CASE("shared structs are rows of 16 bytes and what is pushed fits every device") {
    for (const auto& [name, layout] : kInCpp) {
        CAPTURE(name);
        CHECK(layout.size % 16 == 0);
    }
    CHECK(sizeof(minirt_frame) <= 128);  // maxPushConstantsSize is at least that
    CHECK(sizeof(minirt_vec4) == 16);
    CHECK(sizeof(minirt_uvec4) == 16);
}
