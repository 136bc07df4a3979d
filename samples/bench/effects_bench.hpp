// What it gains that a kernel holds only the effects that its scene calls for: beside the kernel that holds all of them, the same picture by turns.
#pragma once
#include <filesystem>
#include <string>

#include "kernel_statistics.hpp"
#include "timing.hpp"

namespace bench {

struct EffectsOptions {
    std::string device;              // number or part of the name; "": the best
    uint32_t width = 0, height = 0;  // 0: the scene's
    uint32_t samples = 1;
    int rounds = 5;
};

struct KernelResult {
    size_t spirvBytes = 0;
    double firstDispatchMs = 0;  // creation of the pipelines and an empty dispatch, nothing cached
    Spread msPerSample;
    std::vector<KernelStatistics> statistics;  // where the driver gives any
};

struct EffectsResult {
    std::string scene;
    std::string integrator;  // the scene's
    uint32_t width = 0, height = 0;
    KernelResult pruned, whole;
    Spread speedup;  // of the pruned kernel, round by round
};

/// Bakes a scene file (.json) for its own integrator, with and without --all-effects. Throws std::runtime_error or minirtc::Error.
EffectsResult benchEffects(const std::filesystem::path& scene, const EffectsOptions& options);

}  // namespace bench
