// The finished blob: encodes what the stages produced and writes the file.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "bvh.hpp"
#include "effects.hpp"
#include "kernel.hpp"
#include "minirt.h"

namespace minirtc {

/// The two encodings of a Bvh's nodes; docs/blob_format.md gives the bits.
struct EncodedNodes {
    minirt_node_layout layout = MINIRT_NODES_QUANTISED;
    std::vector<uint32_t> words;
    glm::vec3 gridOrigin{0};
    glm::vec3 gridScale{1};
    glm::vec3 gridPlanes{0};
    double sahCost = 0;  // of the boxes as encoded
};

/// 32 bytes a node: boxes rounded outwards to 16 bits on one grid over the scene.
EncodedNodes quantiseNodes(const Bvh& bvh, const Geometry& geometry);

/// 64 bytes a node: boxes as they are.
EncodedNodes floatNodes(const Bvh& bvh, const Geometry& geometry);

enum class LayoutChoice { automatic, quantised, floating };

/// Automatic: 16-bit boxes unless they cost a ray over a tenth more work than exact ones.
EncodedNodes encodeNodes(const Bvh& bvh, const Geometry& geometry, LayoutChoice choice);

/// What the stages before made of a scene.
struct BakedScene {
    const Scene& scene;
    const Geometry& geometry;
    const Bvh& bvh;
    const EncodedNodes& nodes;
    const Volumes& volumes;
    const EffectSet& effects;
    const std::vector<Kernel>& kernels;
};

/// All sections with header, table and checksums, ready for a file. The same input gives the same bytes.
std::vector<uint8_t> assembleBlob(const BakedScene& baked);

/// Writes a file whole or not at all: a temporary file beside it, synced, renamed. Throws Error.
void writeFile(const std::filesystem::path& path, const void* data, size_t size);

/// Throws the Error that writeFile would, where that can be known before the work is done: no such folder, or a folder itself.
void requireWritable(const std::filesystem::path& path);

}  // namespace minirtc
