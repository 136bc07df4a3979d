#include "rounds.hpp"

namespace cost {

void removeDrift(std::vector<std::vector<Timing>>& settings, uint32_t rounds) {
    std::vector<std::vector<double>> relative(rounds);
    for (const std::vector<Timing>& timings : settings) {
        const double median = spreadOf(millisecondsOf(timings)).median;
        for (const Timing& t : timings) relative[t.round].push_back(t.ms / median);
    }
    std::vector<double> drift;
    drift.reserve(rounds);
    for (const std::vector<double>& values : relative) drift.push_back(values.empty() ? 1 : spreadOf(values).median);
    for (std::vector<Timing>& timings : settings)
        for (Timing& t : timings) t.ms /= drift[t.round];
}

std::vector<double> millisecondsOf(const std::vector<Timing>& timings) {
    std::vector<double> ms;
    ms.reserve(timings.size());
    for (const Timing& t : timings) ms.push_back(t.ms);
    return ms;
}

Spread ratioOf(const std::vector<Timing>& a, const std::vector<Timing>& b) {
    std::vector<double> ratios;
    ratios.reserve(a.size() * b.size());
    for (const Timing& above : a)
        for (const Timing& below : b) ratios.push_back(above.ms / below.ms);
    return spreadOf(ratios);
}

bool surelySlower(const Spread& slowdown, const Spread& fastest) {
    return slowdown.median > fastest.median * (1 + kSameTime) && slowdown.lower > fastest.upper;
}

}  // namespace cost
