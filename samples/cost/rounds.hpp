// Times that were measured in rounds, in which all settings took turns.
#pragma once
#include <cstdint>
#include <vector>

#include "../common/spread.hpp"

namespace cost {

struct Timing {
    uint32_t round = 0;
    double ms = 0;
};

/// Takes out by how much whole rounds were faster or slower than others: the median, over all settings, of a time over the median of its setting.
void removeDrift(std::vector<std::vector<Timing>>& settings, uint32_t rounds);

std::vector<double> millisecondsOf(const std::vector<Timing>& timings);

/// Of every time of `a` over every one of `b`.
Spread ratioOf(const std::vector<Timing>& a, const std::vector<Timing>& b);

/// Of the time, that is not worth a change of settings.
constexpr double kSameTime = 0.02;

/// By more than kSameTime and by more than both spread: what is the fastest by chance is then none that shuts out others.
bool surelySlower(const Spread& slowdown, const Spread& fastest);

}  // namespace cost
