// How much of its rays per second each tracer keeps on a larger mesh.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "ray_bench.hpp"

namespace bench {

struct MeshRays {
    uint64_t triangles = 0;
    std::vector<RaySetResult> sets;
};

/// Of one set of rays, from the smallest mesh to a larger one: rays per second there over rays per second here.
struct Scaling {
    std::string rays, peer;
    uint64_t from = 0, to = 0;                        // triangles
    double own = 0, peers = 0;                        // by the wall's or the device's clock
    double ownByProcessor = 0, peersByProcessor = 0;  // by processor time
    /// Above 1: minirt keeps more than its peer.
    double ratio() const { return own / peers; }
    double ratioByProcessor() const { return ownByProcessor / peersByProcessor; }
};

/// Against the peer that must agree with minirt; empty without one, or with one mesh.
std::vector<Scaling> scalingOf(std::vector<MeshRays> meshes);

}  // namespace bench
