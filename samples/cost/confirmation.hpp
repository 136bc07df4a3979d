// Times once more what is recommended: the fastest of many is often so by chance.
#pragma once
#include <functional>

#include "report.hpp"

namespace cost {

/// Measures a configuration in so many rounds, in turn with the scene's own settings. Nothing where it cannot be rendered.
using MeasureAgain = std::function<std::optional<Measurement>(const Configuration& configuration, uint32_t rounds)>;

/// In how many rounds, at most `wanted`, a measurement can be timed again within `seconds`; 0 where not even kLeastRounds fit.
uint32_t affordableRounds(const Report& report, size_t measurement, uint32_t wanted, double seconds);

/// Times what is recommended again, and what takes its place where it was fast by chance, until that stays or no more fits the time that `secondsLeft` tells.
/// Sets the times of what it measured, and report.confirmed.
void confirmRecommendation(const MeasureAgain& measureAgain, uint32_t rounds, const std::function<double()>& secondsLeft,
                           Report& report);

}  // namespace cost
