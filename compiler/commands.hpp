// The subcommands of minirtc. Each returns the exit code or throws Error.
#pragma once
#include <string>

#include "prepared_scene.hpp"

namespace minirtc {

struct BakeOptions {
    std::string scene;
    std::string output;
    bool explain = false;
    Choices choices;
    bool onlyDefault = false;  // kernels of the scene's own integrator alone
    bool shareTrees = false;   // and Whitted's tracer that shares trees
    LayoutChoice layout = LayoutChoice::automatic;
    BvhQuality bvh = BvhQuality::high;
    unsigned threads = 0;     // 0: all cores
    std::string saveGlslDir;  // "": do not
    std::string statsFile;    // "": none
    bool quiet = false;
    Diagnostics* diagnostics = nullptr;  // takes the warnings, which else go to stderr
    KernelCompiler* compiler = nullptr;  // which may know the kernels from before, on its own threads; else its own
};

int bake(const BakeOptions& options);

/// What the scene of a file calls for, before any lever or option, and what draws it.
struct SceneFacts {
    EffectSet effects;
    std::vector<Integrator> integrators;
};
SceneFacts factsOf(const std::string& sceneFile, Diagnostics& diagnostics);

struct LeversOptions {
    std::string scene;  // "": none
    bool json = false;
};

int listLevers(const LeversOptions& options);

struct InspectOptions {
    std::string blob;
    bool json = false;
    bool spirv = false;
};

int inspect(const InspectOptions& options);
int validateBlob(const std::string& path);
int listDevices();

}  // namespace minirtc
