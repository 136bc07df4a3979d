// What a user waits for: minirt-render as a process of its own, from nothing to the file with the picture.
#pragma once
#include <filesystem>
#include <string>

#include "timing.hpp"

namespace bench {

/// Milliseconds. The pipeline's time holds the first dispatch, at which some drivers compile.
struct StartResult {
    double process = 0;  // from its creation to its end
    double load = 0, upload = 0, pipeline = 0;
};

/// A picture of 64 x 64 pixels and one sample. `device`: number or part of the name, "": the best; `cache`: the folder where the driver keeps compiled
/// shaders. Throws std::runtime_error where minirt-render, which is looked for beside this program, fails.
StartResult start(const std::string& device, const std::filesystem::path& blob, const std::filesystem::path& cache);

struct StartSpreads {
    Spread process, load, upload, pipeline;
};

struct StartsResult {
    StartSpreads cold, second;  // the driver's cache of compiled shaders empty, and filled by a start before
};

StartsResult benchStarts(const std::string& device, const std::filesystem::path& blob, int rounds);

}  // namespace bench
