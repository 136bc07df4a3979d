#include "alias_table.hpp"

#include <algorithm>
#include <numeric>

namespace minirtc {
namespace {

constexpr uint32_t kAlways = 0xffffffffu;

uint32_t thresholdOf(double share) {
    constexpr double kSteps = 4294967296.0;
    if (share >= 1) return kAlways;
    return share > 0 ? std::max(1u, static_cast<uint32_t>(share * kSteps)) : 0;
}

}  // namespace

std::vector<AliasEntry> aliasTable(const std::vector<double>& weights) {
    const auto count = static_cast<uint32_t>(weights.size());
    const double largest = *std::max_element(weights.begin(), weights.end());
    std::vector<double> shares;  // of an entry, 1 on average; against overflow the largest weight counts 1 before
    shares.reserve(count);
    for (const double weight : weights) shares.push_back(weight / largest);
    const double scale = count / std::accumulate(shares.begin(), shares.end(), 0.0);
    std::vector<uint32_t> poor, rich;
    for (uint32_t i = 0; i < count; ++i) {
        shares[i] *= scale;
        (shares[i] < 1 ? poor : rich).push_back(i);
    }
    std::vector<AliasEntry> table(count);
    for (uint32_t i = 0; i < count; ++i) table[i] = {i, kAlways};  // for those that rounding leaves over: their share is 1
    while (!poor.empty() && !rich.empty()) {
        const uint32_t small = poor.back(), large = rich.back();
        poor.pop_back();
        table[small] = {large, thresholdOf(shares[small])};
        shares[large] -= 1 - shares[small];
        if (shares[large] >= 1) continue;
        rich.pop_back();
        poor.push_back(large);
    }
    return table;
}

}  // namespace minirtc
