#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "error.hpp"

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

/// What the blob is for. Throws Error.
std::vector<Integrator> integratorsOf(const BakeOptions& options, const Scene& scene) {
    std::vector<Integrator> integrators = scene.render.integrators;
    if (options.onlyDefault) integrators = {scene.render.integrator};
    if (!options.shareTrees) return integrators;
    if (std::none_of(integrators.begin(), integrators.end(), followsTrees))
        throw Error("--share-trees is for the integrator 'whitted', which the blob does not get", "leave it out");
    if (std::find(integrators.begin(), integrators.end(), Integrator::whittedShared) == integrators.end())
        integrators.push_back(Integrator::whittedShared);
    return integrators;
}

}  // namespace

int bake(const BakeOptions& options) {
    const double start = nowMs();
    checkOutputs(options);
    Diagnostics own;
    Diagnostics& diagnostics = options.diagnostics ? *options.diagnostics : own;
    const PreparedScene prepared = prepareScene(options.scene, {options.layout, options.bvh, options.threads}, diagnostics);
    const auto& [scene, geometry, bvh, nodes, volumes] = prepared;
    const std::vector<Integrator> integrators = integratorsOf(options, scene);
    const Variant variant = chooseVariant(prepared, integrators, options.choices);
    KernelCompiler ownCompiler(options.threads);
    KernelCompiler& compiler = options.compiler ? *options.compiler : ownCompiler;
    const std::vector<Kernel> kernels = compiler.compile(kernelJobs(variant, integrators));
    const std::vector<uint8_t> blob = finishBlob(prepared, variant, kernels);

    for (const std::string& warning : own.warnings) std::cerr << warning << "\n";
    if (options.explain) {
        printEffects(variant.effects);
        printLevers(askedLevers(options.choices, scene), scene);
        printVolumes(geometry, volumes);
    }
    if (!options.saveGlslDir.empty()) saveGlsl(options.saveGlslDir, kernels);
    writeFile(options.output, blob.data(), blob.size());
    const double totalMs = nowMs() - start;
    if (!options.statsFile.empty()) writeStats(options.statsFile, geometry, bvh, variant.effects, kernels, blob.size(), totalMs);
    if (!options.quiet) {
        std::cout << options.output << ": " << geometry.primitives.size() << " primitives, " << megabytes(blob.size()) << ", "
                  << static_cast<int>(totalMs) << " ms\n";
    }
    return 0;
}

}  // namespace minirtc
