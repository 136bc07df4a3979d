#include "prepared_scene.hpp"

#include <algorithm>

namespace minirtc {
namespace {

bool tracesPaths(const std::vector<Integrator>& integrators) {
    return std::any_of(integrators.begin(), integrators.end(), [](Integrator one) { return !followsTrees(one); });
}

/// What passed every check of the inputs must pass the runtime's too; numbers that overflow only in combination end here.
void requireValid(const std::string& scene, const std::vector<uint8_t>& blob) {
    minirt_validation validation;
    if (minirt_validate(blob.data(), blob.size(), nullptr, &validation))
        throw Error({scene}, std::string("the baked scene is not valid: ") + validation.message,
                    "are some of its numbers too large?");
}

}  // namespace

PreparedScene prepareScene(const std::string& file, const Preparation& how, Diagnostics& diagnostics) {
    PreparedScene prepared;
    prepared.scene = loadScene(file, diagnostics);
    prepared.geometry = flatten(prepared.scene, diagnostics);
    prepared.bvh = buildBvh(prepared.geometry, how.threads, how.bvh);
    prepared.nodes = encodeNodes(prepared.bvh, prepared.geometry, how.layout);
    prepared.volumes = analyseVolumes(prepared.scene, prepared.geometry, diagnostics, how.threads);
    return prepared;
}

LeverSettings askedLevers(const Choices& choices, const Scene& scene) {
    LeverSettings asked = choices.levers;
    for (const auto& [lever, setting] : asked) requireSetting(lever, setting);
    asked.insert(scene.render.accuracy.begin(), scene.render.accuracy.end());
    return asked;
}

Variant chooseVariant(const PreparedScene& prepared, const std::vector<Integrator>& integrators, const Choices& choices) {
    const LeverSettings asked = askedLevers(choices, prepared.scene);
    const bool floatNodes = prepared.nodes.layout == MINIRT_NODES_FLOAT;
    const auto chosen = [&](bool paths) {
        EffectSet effects = analyseEffects(prepared.scene, prepared.geometry, prepared.volumes, floatNodes, paths);
        applyMethods(asked, effects);
        if (choices.allEffects) includeAll(effects);
        applyToEffects(asked, effects);
        for (const std::string& name : choices.without) removeEffect(effects, findEffect(name), choices.force);
        return effects;
    };
    return {chosen(tracesPaths(integrators)), chosen(false)};
}

std::vector<KernelJob> kernelJobs(const Variant& variant, const std::vector<Integrator>& integrators) {
    std::vector<KernelJob> jobs;
    for (const Integrator integrator : integrators) {
        const EffectSet& effects = followsTrees(integrator) ? variant.whitted : variant.effects;
        for (const std::string& name : kernelsOf(integrator, effects)) jobs.push_back({name, effects});
    }
    return jobs;
}

std::vector<uint32_t> contentOf(const Variant& variant, const std::vector<Kernel>& kernels) {
    std::vector<uint32_t> content;
    for (const EffectChoice& choice : variant.effects.choices) content.push_back(choice.included ? 1 : 0);
    content.push_back(variant.effects.volumeCapacity);
    for (const Kernel& kernel : kernels) content.insert(content.end(), kernel.spirv.begin(), kernel.spirv.end());
    return content;
}

std::vector<uint8_t> finishBlob(const PreparedScene& prepared, const Variant& variant, const std::vector<Kernel>& kernels) {
    const auto& [scene, geometry, bvh, nodes, volumes] = prepared;
    std::vector<uint8_t> blob = assembleBlob({scene, geometry, bvh, nodes, volumes, variant.effects, kernels});
    requireValid(scene.path, blob);
    return blob;
}

}  // namespace minirtc
