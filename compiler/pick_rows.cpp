#include "pick_rows.hpp"

#include <algorithm>
#include <cfloat>
#include <cstring>

#include "alias_table.hpp"

namespace minirtc {

float probabilityOf(double share) {
    return share > 0 ? static_cast<float>(std::clamp(share, double{FLT_MIN}, 1.0)) : 0.0f;
}

std::vector<minirt_pick> pickRows(const std::vector<uint32_t>& entries, const std::vector<double>& weights) {
    const std::vector<AliasEntry> table = aliasTable(weights);
    double total = 0;
    for (const double weight : weights) total += weight;
    std::vector<minirt_pick> rows;
    for (size_t i = 0; i < table.size(); ++i) {
        const float probability = probabilityOf(weights[i] / total);
        uint32_t bits;
        std::memcpy(&bits, &probability, sizeof bits);
        rows.push_back({{entries[i], table[i].alias, table[i].threshold, bits}});
    }
    return rows;
}

}  // namespace minirtc
