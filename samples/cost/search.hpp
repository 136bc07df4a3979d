// Which configurations are worth measuring.
#pragma once
#include "report.hpp"

namespace cost {

/// The scene's own settings first, then each other setting of each lever alone.
std::vector<Configuration> oneAtATime(const std::vector<Lever>& levers);

/// At most `most` combinations of several levers, greedily from what each did alone: first all that saves time at no error; from there, step by step, what removes
/// the most error for its time, and what saves the most time for its error.
std::vector<Configuration> combinations(const std::vector<Lever>& levers, const std::vector<Comparison>& comparisons,
                                        size_t most);

/// How many combinations can be baked and measured so often within `seconds`, by what the single settings took.
size_t affordableCombinations(const Report& report, uint32_t repeats, double seconds);

}  // namespace cost
