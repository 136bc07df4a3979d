#include "timing.hpp"

#include <chrono>
#include <ctime>

namespace bench {
namespace {

double processorMs() {
    return static_cast<double>(std::clock()) * (1e3 / CLOCKS_PER_SEC);
}

}  // namespace

double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Times> takeTurns(const std::vector<Contender>& contenders, int rounds) {
    std::vector<Times> times(contenders.size());
    for (int round = 0; round <= rounds; ++round)
        for (size_t i = 0; i < contenders.size(); ++i) {
            const double before = processorMs();
            const double ms = contenders[i].run();
            if (round == 0) continue;
            times[i].ms.push_back(ms);
            times[i].processorMs.push_back(processorMs() - before);
        }
    return times;
}

Spread ratioTo(const std::vector<double>& reference, const std::vector<double>& own) {
    std::vector<double> ratios;
    for (size_t i = 0; i < own.size(); ++i) ratios.push_back(own[i] > 0 ? reference[i] / own[i] : 0);
    return spreadOf(ratios);
}

}  // namespace bench
