// What it takes to halve the time, and what it does to the error.
#pragma once
#include "report.hpp"

namespace cost {

/// As expected at the scene's own samples a pixel, from the measurements.
struct HalfTime {
    bool fits = false;     // else nothing measured halves the time
    bool advised = false;  // by what is recommended
    BudgetChoice own;
    /// The least error within half the time; where nothing fits, the fastest that surely saves time. Time is expected to grow with the samples.
    std::optional<BudgetChoice> choice;
    double wrongPixels = 0;  // share of all that only the choice gets visibly wrong
};

HalfTime halfTime(const Report& report);

/// "To halve the time, take 32 samples a pixel: about 50 % less time, and the error rises from 0.0100 to 0.0200."
std::string halfTimeSentence(const Report& report);

}  // namespace cost
