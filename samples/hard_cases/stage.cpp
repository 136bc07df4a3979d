#include "stage.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace hard_cases {
namespace {

const std::vector<minirtc::Integrator> kIntegrators = {minirtc::Integrator::whitted};

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

Stage::Stage(minirt_context* context, minirtc::KernelCompiler& compiler) : context_(context), compiler_(compiler) {
    std::string pattern = (std::filesystem::temp_directory_path() / "minirt-hard-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder can be made");
    folder_ = pattern;
}

Stage::~Stage() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void Stage::clear() {
    known_.clear();
    files_.clear();
}

void Stage::write(const std::string& name, const std::string& text) {
    files_[name] = text;
}

Stage::Known& Stage::prepare(const std::string& text) {
    const auto found = known_.find({text, files_});
    if (found != known_.end()) return found->second;
    for (const auto& [name, content] : files_) std::ofstream(folder_ / name, std::ios::binary) << content;
    std::ofstream(folder_ / "scene.json", std::ios::binary) << text;
    minirtc::Diagnostics warnings;  // that a case is hard
    return known_[{text, files_}] = {minirtc::prepareScene((folder_ / "scene.json").string(), {}, warnings), {}};
}

/// Without the levers that cannot change a picture of this scene: they would only compile to the same kernels once more.
minirtc::Choices Stage::choicesFor(const minirtc::PreparedScene& scene) const {
    const minirtc::EffectSet effects = minirtc::chooseVariant(scene, kIntegrators, {}).effects;
    minirtc::Choices choices;
    for (const auto& [lever, setting] : levers_)
        if (minirtc::applies(minirtc::findLever(lever), effects, kIntegrators).applies) choices.levers[lever] = setting;
    return choices;
}

Picture Stage::render(const Shot& shot) {
    Known& known = prepare(sceneOf(shot).dump());
    const minirtc::Variant variant = minirtc::chooseVariant(known.scene, kIntegrators, choicesFor(known.scene));
    const std::vector<minirtc::Kernel> kernels = compiler_.compile(minirtc::kernelJobs(variant, kIntegrators));
    std::vector<uint32_t> content = minirtc::contentOf(variant, kernels);
    const auto found = known.pictures.find(content);
    if (found != known.pictures.end()) return found->second;
    return known.pictures[std::move(content)] = shoot(minirtc::finishBlob(known.scene, variant, kernels), shot.view);
}

Picture Stage::shoot(const std::vector<uint8_t>& blob, const View& view) const {
    minirt_scene* scene = nullptr;
    require(context_, minirt_load_memory(context_, blob.data(), blob.size(), &scene));
    Picture picture;
    picture.size = view.size;
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
