// The levers that a finished blob leaves open: fields of minirt_render_desc.
#pragma once
#include <minirt.h>

#include <string>
#include <vector>

#include "lever.hpp"

namespace cost {

/// What of a blob decides which levers it leaves open.
struct BlobFacts {
    minirt_scene_desc scene = {};
    std::vector<minirt_integrator> integrators;  // that it holds kernels of

    bool has(minirt_integrator integrator) const;
};

/// Throws std::runtime_error that names the file.
BlobFacts readBlobFacts(const std::string& path);

/// SPIR-V of an integrator's kernels in the blob. Throws std::runtime_error.
size_t kernelBytes(const std::string& path, minirt_integrator integrator);

/// The integrator that a rendering of the blob uses where none is asked for.
minirt_integrator defaultIntegrator(const BlobFacts& facts, bool cpuDevice);

/// The open levers of the blob. `samples`: of the scene's own settings.
std::vector<Lever> renderLevers(const BlobFacts& facts, bool cpuDevice, uint32_t samples);

/// The desc that renders a configuration; levers of the bake do not show in it.
minirt_render_desc renderDesc(const std::vector<Lever>& levers, const Configuration& configuration);

/// Samples a pixel of a configuration.
uint32_t samplesOf(const std::vector<Lever>& levers, const Configuration& configuration);

}  // namespace cost
