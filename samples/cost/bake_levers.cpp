#include "bake_levers.hpp"

#include <cstdlib>
#include <iostream>
#include <stdexcept>

namespace cost {
namespace {

/// The compiler's own text explains a setting, which takes longer.
const std::map<std::string, std::string>& words() {
    static const std::map<std::string, std::string> table = {
        {"intersection=moller_trumbore_epsilon", "Möller–Trumbore with an epsilon"},
        {"intersection=moller_trumbore", "Möller–Trumbore intersection"},
        {"intersection=watertight", "watertight intersection"},
        {"ray_offset=constant", "a constant ray offset"},
        {"ray_offset=distance_scaled", "a ray offset scaled by distance"},
        {"ray_offset=error_bounded", "an error-bounded ray offset"},
        {"fresnel=none", "no Fresnel reflection"},
        {"fresnel=schlick", "Schlick's Fresnel"},
        {"fresnel=exact", "exact Fresnel"},
        {"normals=flat", "flat normals"},
        {"normals=smooth", "smooth normals"},
        {"nesting=off", "no nesting of volumes"},
        {"nesting=parity", "nesting by parity"},
        {"nesting=ordered", "ordered nesting of volumes"},
        {"absorption=off", "no absorption"},
        {"absorption=on", "absorption"},
        {"dispersion=off", "no dispersion"},
        {"dispersion=rgb", "dispersion in three channels"},
        {"dispersion=spectral", "spectral dispersion"},
        {"precision=float", "single precision"},
        {"precision=double", "double precision"},
        {"weak_rays=dropped", "weak rays that end"},
        {"weak_rays=roulette", "Russian roulette of weak rays"},
    };
    return table;
}

std::string titleOf(const std::string& name) {
    static const std::map<std::string, std::string> titles = {
        {"intersection", "Intersection"}, {"ray_offset", "Ray offset"},      {"fresnel", "Fresnel"},
        {"normals", "Normals"},           {"nesting", "Nesting of volumes"}, {"absorption", "Absorption"},
        {"dispersion", "Dispersion"},     {"precision", "Precision"},        {"weak_rays", "Weak rays"}};
    const auto found = titles.find(name);
    return found == titles.end() ? name : found->second;
}

Lever leverOf(const minirtc::Lever& source, const std::string& own, const minirtc::Applicability& applicability) {
    Lever lever{LeverKind::baked, source.name, titleOf(source.name), {}, 0, 0, source.name == "normals", ""};
    for (const minirtc::LeverSetting& setting : source.settings) {
        if (setting.name == own) lever.initial = lever.settings.size();
        lever.settings.push_back({setting.name, wordsOf(source.name, setting.name), 0});
    }
    lever.best = applicability.applies ? lever.settings.size() - 1 : lever.initial;
    if (!applicability.applies) lever.idle = applicability.reason;
    return lever;
}

minirtc::Integrator integratorOf(minirt_integrator integrator) {
    return static_cast<minirtc::Integrator>(static_cast<uint32_t>(integrator) - MINIRT_INTEGRATOR_WHITTED);
}

}  // namespace

std::string wordsOf(const std::string& lever, const std::string& setting) {
    const auto found = words().find(lever + "=" + setting);
    return found == words().end() ? lever + " " + setting : found->second;
}

Baker::Baker(const std::string& sceneFile) {
    minirtc::Diagnostics diagnostics;
    prepared_ = minirtc::prepareScene(sceneFile, {}, diagnostics);
    for (const std::string& warning : diagnostics.warnings) std::cerr << warning << "\n";
    const minirtc::RenderDefaults& render = prepared_.scene.render;
    integrators_ = render.integrators;
    if (minirtc::followsTrees(render.integrator)) integrators_ = {minirtc::Integrator::whitted};
    std::string pattern = (std::filesystem::temp_directory_path() / "minirt-cost-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error(pattern + ": cannot be made; is there room for temporary files?");
    folder_ = pattern;
}

Baker::~Baker() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::vector<Lever> Baker::levers() const {
    const auto& [scene, geometry, bvh, nodes, volumes] = prepared_;
    // What the scene asks for: another integrator is a lever itself, and moves alone.
    const bool paths = !minirtc::followsTrees(scene.render.integrator);
    const minirtc::EffectSet effects = minirtc::analyseEffects(scene, geometry, volumes, false, paths);
    std::vector<Lever> levers;
    for (const minirtc::Lever& lever : minirtc::levers()) {
        if (lever.when == minirtc::LeverTime::bake)
            levers.push_back(leverOf(lever, minirtc::settingOf(lever, scene.render.accuracy, scene),
                                     minirtc::applies(lever, effects, {scene.render.integrator})));
    }
    return levers;
}

Baker::Wish Baker::wishOf(const std::vector<Lever>& levers, const Configuration& configuration) const {
    Wish wish{{}, integrators_};
    for (size_t i = 0; i < levers.size(); ++i)
        if (levers[i].kind == LeverKind::baked && configuration[i] != levers[i].initial)
            wish.settings[levers[i].name] = levers[i].settings[configuration[i]].name;
    const minirt_integrator one = renderDesc(levers, configuration).integrator;
    if (!wish.settings.empty() && one != MINIRT_INTEGRATOR_SCENE) wish.integrators = {integratorOf(one)};
    return wish;
}

std::vector<std::string> Baker::blobsOf(const std::vector<Lever>& levers, const std::vector<Configuration>& configurations) {
    std::vector<Wish> wishes;
    std::vector<Wish> fresh;
    for (const Configuration& configuration : configurations) {
        wishes.push_back(wishOf(levers, configuration));
        if (blobs_.try_emplace(wishes.back()).second) fresh.push_back(wishes.back());
    }
    bake(fresh);
    std::vector<std::string> paths;
    paths.reserve(wishes.size());
    for (const Wish& wish : wishes) paths.push_back(blobs_.at(wish));
    return paths;
}

void Baker::bake(const std::vector<Wish>& wishes) {
    std::vector<minirtc::Variant> variants;
    std::vector<minirtc::KernelJob> jobs;
    for (const Wish& wish : wishes) {
        minirtc::Choices choices;
        choices.levers = wish.settings;
        variants.push_back(minirtc::chooseVariant(prepared_, integrators_, choices));
        for (minirtc::KernelJob& job : minirtc::kernelJobs(variants.back(), wish.integrators)) jobs.push_back(std::move(job));
    }
    compiler_.compile(jobs);
    for (size_t i = 0; i < wishes.size(); ++i) {
        const std::vector<minirtc::Kernel> kernels = compiler_.compile(minirtc::kernelJobs(variants[i], wishes[i].integrators));
        std::string& content = contents_[minirtc::contentOf(variants[i], kernels)];
        if (content.empty()) {
            content = (folder_ / (std::to_string(contents_.size()) + ".mrt")).string();
            const std::vector<uint8_t> blob = minirtc::finishBlob(prepared_, variants[i], kernels);
            minirtc::writeFile(content, blob.data(), blob.size());
        }
        blobs_.at(wishes[i]) = content;
    }
}

}  // namespace cost
