// Whole pictures of scenes, by each integrator, and what it takes until the first one is there.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "load_bench.hpp"
#include "stage.hpp"
#include "start_bench.hpp"
#include "timing.hpp"

namespace bench {

struct FrameOptions {
    std::string device;  // number or part of the name; "": the best
    uint32_t samples = 4;
    int rounds = 5;
    bool pictures = true;  // else only starts and loads
};

struct FrameResult {
    std::string integrator;
    Spread msPerSample;
    Spread mraysPerSecond;
};

struct SceneResult {
    std::string scene;
    uint32_t width = 0, height = 0;
    uint64_t blobBytes = 0;
    double bakeMs = 0;  // 0: it was a blob already
    StartsResult starts;
    LoadResult load;
    std::vector<FrameResult> frames;
};

/// `file`: a blob, or a scene that is baked first. Throws std::runtime_error or minirtc::Error.
SceneResult benchScene(const std::filesystem::path& file, const FrameOptions& options);

}  // namespace bench
