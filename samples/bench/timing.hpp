// Medians of runs that take turns.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "../common/spread.hpp"

namespace bench {

double nowMs();

/// One of several that do the same work: `run` does it once and returns the milliseconds.
struct Contender {
    std::string name;
    std::function<double()> run;
};

/// Of one contender, a value a round.
struct Times {
    std::vector<double> ms;           // as `run` says
    std::vector<double> processorMs;  // of all threads of this process, so that other programs on the machine matter less
};

/// Rounds go A B C A B C, so that what slows the machine down for a while hits all alike; a first round, which warms caches up, does
/// not count.
std::vector<Times> takeTurns(const std::vector<Contender>& contenders, int rounds);

/// reference / own of each round: how many times faster than the reference.
Spread ratioTo(const std::vector<double>& reference, const std::vector<double>& own);

}  // namespace bench
