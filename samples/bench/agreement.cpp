#include "agreement.hpp"

#include <cmath>

namespace bench {

Agreement agreement(const std::vector<Hit>& first, const std::vector<Hit>& second, bool anyHit, float tolerance) {
    Agreement result;
    result.rays = first.size();
    for (size_t i = 0; i < first.size(); ++i) {
        const bool a = first[i].primitive != kNoHit, b = second[i].primitive != kNoHit;
        result.hits += a;
        result.onlyOne += a != b;
        result.distance += a && b && !anyHit && !(std::abs(first[i].t - second[i].t) <= tolerance);
    }
    return result;
}

}  // namespace bench
