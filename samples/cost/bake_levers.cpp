#include "bake_levers.hpp"

#include <commands.hpp>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

namespace cost {
namespace {

/// What a setting is called in a sentence; the compiler's own text explains it, which takes longer.
const std::map<std::string, std::string>& words() {
    static const std::map<std::string, std::string> table = {
        {"intersection=moller_trumbore_epsilon", "Möller and Trumbore's intersection with an epsilon"},
        {"intersection=moller_trumbore", "Möller and Trumbore's intersection"},
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
    };
    return table;
}

std::string titleOf(const std::string& name) {
    static const std::map<std::string, std::string> titles = {
        {"intersection", "Intersection"}, {"ray_offset", "Ray offset"}, {"fresnel", "Fresnel"},       {"normals", "Normals"},
        {"nesting", "Nested volumes"},    {"absorption", "Absorption"}, {"dispersion", "Dispersion"}, {"precision", "Precision"}};
    const auto found = titles.find(name);
    return found == titles.end() ? name : found->second;
}

Lever leverOf(const minirtc::Lever& source, const std::string& own, const minirtc::Applicability& applicability) {
    Lever lever{LeverKind::baked, source.name, titleOf(source.name), {}, 0, 0, source.name == "normals", ""};
    for (const minirtc::LeverSetting& setting : source.settings) {
        if (setting.name == own) lever.initial = lever.settings.size();
        const auto found = words().find(source.name + "=" + setting.name);
        lever.settings.push_back({setting.name, found == words().end() ? source.name + " " + setting.name : found->second, 0});
    }
    lever.best = applicability.applies ? lever.settings.size() - 1 : lever.initial;
    if (!applicability.applies) lever.idle = applicability.reason;
    return lever;
}

/// The compiler's warnings once, not with every variant of the scene.
class SilencedErrors {
public:
    explicit SilencedErrors(bool silence) : buffer_(std::cerr.rdbuf()) {
        if (silence) std::cerr.rdbuf(nullptr);
    }
    ~SilencedErrors() {
        std::cerr.rdbuf(buffer_);
        std::cerr.clear();
    }
    SilencedErrors(const SilencedErrors&) = delete;
    SilencedErrors& operator=(const SilencedErrors&) = delete;

private:
    std::streambuf* buffer_;
};

}  // namespace

std::vector<Lever> bakeLevers(const std::string& sceneFile) {
    minirtc::Diagnostics diagnostics;
    const minirtc::Scene scene = minirtc::loadScene(sceneFile, diagnostics);
    const minirtc::Geometry geometry = minirtc::flatten(scene, diagnostics);
    const minirtc::Volumes volumes = minirtc::analyseVolumes(scene, geometry, diagnostics, 0);
    const bool paths = scene.render.integrator != minirtc::Integrator::whitted;
    const minirtc::EffectSet effects = minirtc::analyseEffects(scene, geometry, volumes, false, paths);
    std::vector<Lever> levers;
    for (const minirtc::Lever& lever : minirtc::levers()) {
        if (lever.when == minirtc::LeverTime::bake)
            levers.push_back(
                leverOf(lever, minirtc::settingOf(lever, scene.render.accuracy, scene), minirtc::applies(lever, effects)));
    }
    return levers;
}

bool asksForWhitted(const std::string& sceneFile) {
    minirtc::Diagnostics diagnostics;
    return minirtc::loadScene(sceneFile, diagnostics).render.integrator == minirtc::Integrator::whitted;
}

Baker::Baker(std::string sceneFile, bool onlyDefault) : sceneFile_(std::move(sceneFile)), onlyDefault_(onlyDefault) {
    std::string pattern = (std::filesystem::temp_directory_path() / "minirt-cost-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error(pattern + ": cannot be made; is there room for temporary files?");
    folder_ = pattern;
}

Baker::~Baker() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string Baker::blobOf(const std::vector<Lever>& levers, const Configuration& configuration) {
    minirtc::BakeOptions options;
    for (size_t i = 0; i < levers.size(); ++i)
        if (levers[i].kind == LeverKind::baked && configuration[i] != levers[i].initial)
            options.levers[levers[i].name] = levers[i].settings[configuration[i]].name;
    std::string& blob = blobs_[options.levers];
    if (!blob.empty()) return blob;
    options.scene = sceneFile_;
    options.output = (folder_ / (std::to_string(blobs_.size()) + ".mrt")).string();
    options.onlyDefault = onlyDefault_;
    options.quiet = true;
    const SilencedErrors silenced(!options.levers.empty());
    minirtc::bake(options);
    return blob = options.output;
}

}  // namespace cost
