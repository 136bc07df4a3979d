#include "tree_bench.hpp"

#include "embree_rays.hpp"
#include "embree_tree.hpp"

namespace bench {

std::vector<TreeResult> benchTrees(const Mesh& mesh, int rounds) {
    std::vector<TreeResult> results;
    std::vector<Contender> contenders;
    const auto add = [&](const std::string& name, const std::function<minirtc::Bvh()>& build) {
        const size_t i = results.size();
        results.push_back({name, {}, 0, 0, 0});
        contenders.push_back({name, [&results, i, build] {
                                  const minirtc::Bvh bvh = build();
                                  results[i].sahCost = bvh.sahCost;
                                  results[i].nodes = bvh.nodes.size();
                                  results[i].references = bvh.order.size();
                                  return bvh.buildMs;
                              }});
    };
    add("minirt fast", [&] { return minirtc::buildBvh(mesh.geometry, 0, minirtc::BvhQuality::fast); });
    add("minirt high", [&] { return minirtc::buildBvh(mesh.geometry, 0, minirtc::BvhQuality::high); });
    if (EmbreeScene::available()) {
        add("Embree low", [&] { return embreeTree(mesh.triangles, EmbreeQuality::low); });
        add("Embree medium", [&] { return embreeTree(mesh.triangles, EmbreeQuality::medium); });
        add("Embree high", [&] { return embreeTree(mesh.triangles, EmbreeQuality::high); });
    }
    const std::vector<Times> times = takeTurns(contenders, rounds);
    for (size_t i = 0; i < results.size(); ++i) {
        std::vector<double> rates;
        for (double one : times[i].ms) rates.push_back(static_cast<double>(mesh.triangles.size()) / one * 1e-3);
        results[i].mtrianglesPerSecond = spreadOf(rates);
    }
    return results;
}

}  // namespace bench
