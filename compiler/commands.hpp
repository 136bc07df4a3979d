// The subcommands of minirtc. Each returns the exit code or throws Error.
#pragma once
#include <string>

#include "blob.hpp"

namespace minirtc {

struct BakeOptions {
    std::string scene;
    std::string output;
    bool explain = false;
    bool allEffects = false;
    bool onlyDefault = false;  // kernels of the scene's own integrator alone
    LayoutChoice layout = LayoutChoice::automatic;
    BvhQuality bvh = BvhQuality::high;
    unsigned threads = 0;     // 0: all cores
    std::string saveGlslDir;  // "": do not
    std::string statsFile;    // "": none
    bool quiet = false;
};

int bake(const BakeOptions& options);

struct InspectOptions {
    std::string blob;
    bool json = false;
    bool spirv = false;
};

int inspect(const InspectOptions& options);
int validateBlob(const std::string& path);
int listDevices();

}  // namespace minirtc
