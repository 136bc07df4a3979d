#include "scaling.hpp"

#include <algorithm>

namespace bench {
namespace {

const RaySetResult* find(const MeshRays& mesh, const std::string& rays) {
    const auto found =
        std::find_if(mesh.sets.begin(), mesh.sets.end(), [&](const RaySetResult& set) { return set.rays == rays; });
    return found == mesh.sets.end() ? nullptr : &*found;
}

const ContenderResult* peerIn(const RaySetResult& set) {
    const auto found =
        std::find_if(set.contenders.begin(), set.contenders.end(), [](const ContenderResult& c) { return c.mustAgree; });
    return found == set.contenders.end() ? nullptr : &*found;
}

double kept(const Spread& small, const Spread& large) {
    return large.median / small.median;
}

}  // namespace

std::vector<Scaling> scalingOf(std::vector<MeshRays> meshes) {
    std::sort(meshes.begin(), meshes.end(), [](const MeshRays& a, const MeshRays& b) { return a.triangles < b.triangles; });
    std::vector<Scaling> result;
    for (size_t i = 1; i < meshes.size(); ++i)
        for (const RaySetResult& large : meshes[i].sets) {
            const RaySetResult* const small = find(meshes[0], large.rays);
            const ContenderResult* const after = peerIn(large);
            const ContenderResult* const before = small ? peerIn(*small) : nullptr;
            if (!before || !after) continue;
            const ContenderResult& own = small->contenders.front();
            const ContenderResult& ownAfter = large.contenders.front();
            result.push_back(
                {large.rays, after->name, meshes[0].triangles, meshes[i].triangles,
                 kept(own.mraysPerSecond, ownAfter.mraysPerSecond), kept(before->mraysPerSecond, after->mraysPerSecond),
                 1 / kept(own.processorNs, ownAfter.processorNs), 1 / kept(before->processorNs, after->processorNs)});
        }
    return result;
}

}  // namespace bench
