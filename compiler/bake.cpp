#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"

namespace minirtc {
namespace {

double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void printEffects(const EffectSet& effects) {
    for (size_t i = 0; i < kEffectCount; ++i) {
        const EffectChoice& choice = effects.choices[i];
        std::cout << (choice.included ? "in   " : "out  ") << effectInfo(static_cast<Effect>(i)).name << ": " << choice.reason
                  << "\n";
    }
}

/// The levers that are not at their default.
void printLevers(const LeverSettings& asked, const Scene& scene) {
    for (const Lever& lever : levers()) {
        const std::string setting = lever.when == LeverTime::bake ? settingOf(lever, asked, scene) : lever.byDefault;
        if (setting != lever.byDefault)
            std::cout << "set  " << lever.name << ": " << setting << ", by default " << lever.byDefault << "\n";
    }
}

void printVolumes(const Geometry& geometry, const Volumes& volumes) {
    for (const Displacement& pair : volumes.displacements) {
        std::cout << geometry.bodies[pair.above].name << " displaces " << geometry.bodies[pair.below].name << ": " << pair.reason
                  << "\n";
    }
}

void saveGlsl(const std::string& dir, const std::vector<Kernel>& kernels) {
    std::filesystem::create_directories(dir);
    for (const Kernel& kernel : kernels)
        writeFile(std::filesystem::path(dir) / (kernel.name + ".comp"), kernel.glsl.data(), kernel.glsl.size());
}

void writeStats(const std::string& path, const Geometry& geometry, const Bvh& bvh, const EffectSet& effects,
                const std::vector<Kernel>& kernels, size_t blobBytes, double totalMs) {
    nlohmann::ordered_json json;
    json["triangles"] = geometry.primitives.size();
    json["degenerate_triangles"] = geometry.degenerateTriangles;
    json["bvh"] = {{"nodes", bvh.nodes.size()},
                   {"leaves", bvh.leaves},
                   {"max_depth", bvh.depth},
                   {"sah_cost", bvh.sahCost},
                   {"build_ms", bvh.buildMs}};
    for (size_t i = 0; i < kEffectCount; ++i) {
        json["effects"][effectInfo(static_cast<Effect>(i)).name] = {{"included", effects.choices[i].included},
                                                                    {"reason", effects.choices[i].reason}};
    }
    size_t spirvBytes = 0;
    for (const Kernel& kernel : kernels) spirvBytes += kernel.spirv.size() * sizeof(uint32_t);
    json["spirv_bytes"] = spirvBytes;
    json["blob_bytes"] = blobBytes;
    json["total_ms"] = totalMs;
    const std::string text = json.dump(2) + "\n";
    writeFile(path, text.data(), text.size());
}

/// The kernels of all integrators that the blob is for. Whitted's holds what it needs alone, the others share theirs.
std::vector<Kernel> compileKernels(const std::vector<Integrator>& integrators, const EffectSet& whitted, const EffectSet& all) {
    std::vector<Kernel> kernels;
    for (Integrator integrator : integrators) {
        const EffectSet& effects = integrator == Integrator::whitted ? whitted : all;
        for (const std::string& name : kernelsOf(integrator, effects)) kernels.push_back(compileKernel(name, effects));
    }
    return kernels;
}

/// The settings of all levers that were asked for: by the options, else by the scene file.
LeverSettings askedLevers(const BakeOptions& options, const Scene& scene) {
    LeverSettings asked = options.levers;
    for (const auto& [lever, setting] : asked) requireSetting(lever, setting);
    asked.insert(scene.render.accuracy.begin(), scene.render.accuracy.end());
    return asked;
}

/// What the options and the levers make of what the scene calls for.
EffectSet chosenEffects(EffectSet effects, const BakeOptions& options, const LeverSettings& asked) {
    if (options.allEffects) includeAll(effects);
    applyToEffects(asked, effects);
    for (const std::string& name : options.without) removeEffect(effects, findEffect(name), options.force);
    return effects;
}

/// Finds before the work what would keep its result from being written.
void checkOutputs(const BakeOptions& options) {
    requireWritable(options.output);
    if (!options.statsFile.empty()) requireWritable(options.statsFile);
    std::error_code absent;
    if (std::filesystem::equivalent(options.scene, options.output, absent))
        throw Error({options.output}, "is the scene itself", "name another file with -o");
}

std::string megabytes(size_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) * 1e-6);
    return text;
}

/// What passed every check of the inputs must pass the runtime's too; numbers that overflow only in combination end here.
void requireValid(const std::string& scene, const std::vector<uint8_t>& blob) {
    minirt_validation validation;
    if (minirt_validate(blob.data(), blob.size(), nullptr, &validation))
        throw Error({scene}, std::string("the baked scene is not valid: ") + validation.message,
                    "are some of its numbers too large?");
}

}  // namespace

int bake(const BakeOptions& options) {
    const double start = nowMs();
    checkOutputs(options);
    Diagnostics own;
    Diagnostics& diagnostics = options.diagnostics ? *options.diagnostics : own;
    Scene scene = loadScene(options.scene, diagnostics);
    const LeverSettings asked = askedLevers(options, scene);
    applyToScene(asked, scene);
    if (options.onlyDefault) scene.render.integrators = {scene.render.integrator};
    const Geometry geometry = flatten(scene, diagnostics);
    const Bvh bvh = buildBvh(geometry, options.threads, options.bvh);
    const EncodedNodes nodes = encodeNodes(bvh, geometry, options.layout);
    const Volumes volumes = analyseVolumes(scene, geometry, diagnostics, options.threads);
    const bool floatNodes = nodes.layout == MINIRT_NODES_FLOAT;
    const auto effectsFor = [&](bool paths) {
        return chosenEffects(analyseEffects(scene, geometry, volumes, floatNodes, paths), options, asked);
    };
    const EffectSet effects = effectsFor(scene.render.tracesPaths());
    const EffectSet whitted = effectsFor(false);
    const std::vector<Kernel> kernels = compileKernels(scene.render.integrators, whitted, effects);
    const std::vector<uint8_t> blob = assembleBlob({scene, geometry, bvh, nodes, volumes, effects, kernels});

    requireValid(options.scene, blob);

    for (const std::string& warning : own.warnings) std::cerr << warning << "\n";
    if (options.explain) {
        printEffects(effects);
        printLevers(asked, scene);
        printVolumes(geometry, volumes);
    }
    if (!options.saveGlslDir.empty()) saveGlsl(options.saveGlslDir, kernels);
    writeFile(options.output, blob.data(), blob.size());
    const double totalMs = nowMs() - start;
    if (!options.statsFile.empty()) writeStats(options.statsFile, geometry, bvh, effects, kernels, blob.size(), totalMs);
    if (!options.quiet) {
        std::cout << options.output << ": " << geometry.primitives.size() << " primitives, " << megabytes(blob.size()) << ", "
                  << static_cast<int>(totalMs) << " ms\n";
    }
    return 0;
}

}  // namespace minirtc
