#include <cstring>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <spirv-tools/libspirv.hpp>
#include <sstream>

#include "commands.hpp"

namespace minirtc {
namespace {

std::vector<uint8_t> readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path)) throw Error({path}, "cannot be opened", "does the file exist?");
    std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(file), {});
    if (bytes.empty()) throw Error({path}, "is empty", "bake the scene again");
    return bytes;
}

/// The parts of a valid blob; `bytes` must outlive them.
minirt_blob open(const std::string& path, const std::vector<uint8_t>& bytes) {
    minirt_blob blob;
    minirt_validation validation;
    const minirt_result result = minirt_validate(bytes.data(), bytes.size(), &blob, &validation);
    const bool saysWhatToDo = std::strchr(validation.message, ';');
    if (result)
        throw Error({path}, validation.message, saysWhatToDo ? "" : "bake a scene with: minirtc bake SCENE.json -o SCENE.mrt");
    return blob;
}

nlohmann::ordered_json describe(const minirt_blob& blob) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(blob.explain, blob.explain + blob.explain_size);
    const minirt_scene_desc& scene = *blob.scene;
    json["format_version"] = MINIRT_FORMAT_VERSION;
    json["bytes"] = blob.total_size;
    json["counts"] = {{"nodes", blob.node_count},
                      {"primitives", blob.primitive_count},
                      {"smooth_or_textured", std::max(blob.normal_count, blob.uv_count)},
                      {"materials", blob.material_count},
                      {"lights", blob.light_count},
                      {"images", blob.image_count},
                      {"texels", blob.texel_count}};
    json["node_layout"] = scene.node_layout == MINIRT_NODES_FLOAT ? "float" : "quantised";
    json["defaults"] = {{"width", scene.width},
                        {"height", scene.height},
                        {"spp", scene.samples},
                        {"max_depth", scene.max_depth},
                        {"throughput_cutoff", scene.throughput_cutoff}};
    for (uint64_t i = 0; i < blob.kernel_count; ++i) {
        json["kernels"].push_back({{"name", blob.kernels[i].name},
                                   {"spirv_bytes", blob.kernels[i].spirv_size},
                                   {"bindings", blob.kernels[i].bindings}});
    }
    return json;
}

void print(const nlohmann::ordered_json& json) {
    std::cout << json["bytes"] << " bytes, format " << json["format_version"] << "\n";
    for (const char* part : {"counts", "defaults", "bvh"})
        for (const auto& [key, value] : json[part].items()) std::cout << std::left << std::setw(20) << key << value << "\n";
    std::cout << std::setw(20) << "node layout" << json["node_layout"].get<std::string>() << "\n";
    for (const auto& kernel : json["kernels"])
        std::cout << "kernel " << kernel["name"].get<std::string>() << ": " << kernel["spirv_bytes"] << " bytes of SPIR-V\n";
    for (const auto& [name, effect] : json["effects"].items())
        std::cout << (effect["included"] ? "in   " : "out  ") << name << ": " << effect["reason"].get<std::string>() << "\n";
    if (!json.contains("levers")) return;
    for (const auto& [lever, setting] : json["levers"].items())
        std::cout << "set  " << lever << ": " << setting.get<std::string>() << "\n";
}

void printSpirv(const minirt_blob& blob) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    for (uint64_t i = 0; i < blob.kernel_count; ++i) {
        std::vector<uint32_t> words(blob.kernels[i].spirv_size / sizeof(uint32_t));
        std::memcpy(words.data(), blob.spirv + blob.kernels[i].spirv_offset, blob.kernels[i].spirv_size);
        std::string text;
        tools.Disassemble(words, &text);
        std::cout << "; kernel " << blob.kernels[i].name << "\n" << text;
    }
}

}  // namespace

int inspect(const InspectOptions& options) {
    const std::vector<uint8_t> bytes = readFile(options.blob);
    const minirt_blob blob = open(options.blob, bytes);
    const nlohmann::ordered_json json = describe(blob);
    if (options.json)
        std::cout << json.dump(2) << "\n";
    else if (!options.spirv)
        print(json);
    if (options.spirv) printSpirv(blob);
    return 0;
}

int validateBlob(const std::string& path) {
    const std::vector<uint8_t> bytes = readFile(path);
    open(path, bytes);
    std::cout << path << ": valid\n";
    return 0;
}

int listDevices() {
    constexpr uint32_t kRoom = 16;
    minirt_device_info infos[kRoom];
    uint32_t count = kRoom;
    const minirt_result result = minirt_list_devices(nullptr, infos, &count);
    if (result) throw Error(minirt_result_string(result), "");
    for (uint32_t i = 0; i < std::min(count, kRoom); ++i) {
        std::cout << i << "  " << infos[i].name << " (" << infos[i].driver << (infos[i].is_cpu ? ", on the CPU" : "") << ", "
                  << (infos[i].memory_bytes >> 20) << " MiB)\n";
    }
    if (count == 0) throw Error("no Vulkan device found", "install a driver (Debian: mesa-vulkan-drivers renders without a GPU)");
    return 0;
}

}  // namespace minirtc
