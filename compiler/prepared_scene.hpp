// The stages that no accuracy lever and no choice of effects touches, done once for all blobs of a scene; and what the choices make of them.
#pragma once
#include "blob.hpp"
#include "levers.hpp"

namespace minirtc {

struct Preparation {
    LayoutChoice layout = LayoutChoice::automatic;
    BvhQuality bvh = BvhQuality::high;
    unsigned threads = 0;  // 0: all cores
};

/// All of a blob but what its kernels decide.
struct PreparedScene {
    Scene scene;
    Geometry geometry;
    Bvh bvh;
    EncodedNodes nodes;
    Volumes volumes;
};

/// From a scene file and all that it names. Throws Error.
PreparedScene prepareScene(const std::string& file, const Preparation& how, Diagnostics& diagnostics);

/// What tells one blob of a scene from another.
struct Choices {
    bool allEffects = false;
    std::vector<std::string> without;  // effects to leave out
    bool force = false;                // also where the scene calls for them
    LeverSettings levers;              // over what the scene file says
};

/// The effects that a blob's kernels are made of.
struct Variant {
    EffectSet effects;  // of the path tracers, and of the blob's data
    EffectSet whitted;  // of Whitted's kernel, which holds what it needs alone
};

/// The settings of all levers that are asked for: by the choices, else by the scene file. Throws Error where there is none such.
LeverSettings askedLevers(const Choices& choices, const Scene& scene);

/// Throws Error where an effect cannot be left out. The kernels are for `integrators`.
Variant chooseVariant(const PreparedScene& prepared, const std::vector<Integrator>& integrators, const Choices& choices);

/// The kernels of these integrators.
std::vector<KernelJob> kernelJobs(const Variant& variant, const std::vector<Integrator>& integrators);

/// What of a blob a variant decides: its effects, which say what data it has, and its kernels. Blobs of a scene in which it is equal render alike.
std::vector<uint32_t> contentOf(const Variant& variant, const std::vector<Kernel>& kernels);

/// The blob, which has passed the runtime's own checks. Throws Error.
std::vector<uint8_t> finishBlob(const PreparedScene& prepared, const Variant& variant, const std::vector<Kernel>& kernels);

}  // namespace minirtc
