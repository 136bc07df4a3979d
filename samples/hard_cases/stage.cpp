#include "stage.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "commands.hpp"

namespace hard_cases {
namespace {

void require(minirt_context* context, minirt_result result) {
    if (result) throw std::runtime_error(std::string(minirt_result_string(result)) + ": " + minirt_last_message(context));
}

Json sceneOf(const Shot& shot) {
    const View& view = shot.view;
    Json scene;
    scene["camera"] = {{"position", at(view.position)}, {"target", at(view.target)}, {"up", at(view.up)}, {"vfov", view.vfov}};
    if (shot.panorama.empty())
        scene["background"]["color"] = at(dvec3(shot.background));
    else
        scene["background"]["image"] = shot.panorama;
    scene["render"] = {{"size", {view.size, view.size}}, {"maxDepth", shot.maxDepth}, {"integrators", {"whitted"}}};
    scene["materials"] = shot.materials;
    scene["objects"] = shot.objects;
    scene["lights"] = shot.lights;
    return scene;
}

}  // namespace

dvec3 View::direction(uint32_t x, uint32_t y) const {
    const dvec3 forward = glm::normalize(target - position);
    const dvec3 right = glm::normalize(glm::cross(forward, up));
    const double half = std::tan(glm::radians(vfov) / 2);
    const double u = ((x + 0.5) / size * 2 - 1) * half;
    const double v = ((y + 0.5) / size * 2 - 1) * half;
    return glm::normalize(forward + u * right - v * glm::cross(right, forward));
}

Stage::Stage(minirt_context* context, const minirtc::LeverSettings& levers) : context_(context), levers_(levers) {
    std::string pattern = (std::filesystem::temp_directory_path() / "minirt-hard-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder can be made");
    folder_ = pattern;
}

Stage::~Stage() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void Stage::write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
}

Picture Stage::render(const Shot& shot) const {
    write("scene.json", sceneOf(shot).dump());
    minirtc::BakeOptions options;
    options.scene = (folder_ / "scene.json").string();
    options.output = (folder_ / "scene.mrt").string();
    options.choices.levers = levers_;
    options.quiet = true;
    minirtc::Diagnostics warnings;  // that a case is hard
    options.diagnostics = &warnings;
    minirtc::bake(options);
    minirt_scene* scene = nullptr;
    require(context_, minirt_load_file(context_, options.output.c_str(), &scene));
    Picture picture;
    picture.size = shot.view.size;
    picture.rgba.resize(size_t{picture.size} * picture.size * 4);
    minirt_render_desc desc = {};
    desc.stats = &picture.stats;
    desc.throughput_cutoff = -1;
    const minirt_result result = minirt_render(scene, &desc, picture.rgba.data());
    minirt_unload(scene);
    require(context_, result);
    return picture;
}

}  // namespace hard_cases
