#include "timing.hpp"

#include <algorithm>
#include <chrono>

namespace bench {

double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Spread spreadOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

std::vector<std::vector<double>> takeTurns(const std::vector<Contender>& contenders, int rounds) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int round = 0; round <= rounds; ++round)
        for (size_t i = 0; i < contenders.size(); ++i) {
            const double ms = contenders[i].run();
            if (round > 0) times[i].push_back(ms);
        }
    return times;
}

Spread ratioTo(const std::vector<double>& reference, const std::vector<double>& own) {
    std::vector<double> ratios;
    for (size_t i = 0; i < own.size(); ++i) ratios.push_back(reference[i] / own[i]);
    return spreadOf(ratios);
}

}  // namespace bench
