// What it takes to halve the time, and what it does to the error.
#pragma once
#include "report.hpp"

namespace cost {

/// At the scene's own samples a pixel.
struct HalfTime {
    bool fits = false;     // else nothing measured halves the time
    bool advised = false;  // by what is recommended
    BudgetChoice own;
    /// The least error within half the time, or what was measured with about as many samples and fits as well; where nothing fits, the fastest that surely
    /// saves time. Time is expected to grow with the samples as it did in what was measured.
    std::optional<BudgetChoice> choice;
    std::optional<size_t> measurement;  // that is this choice; else its figures are expected by its samples
    double wrongPixels = 0;             // share of all that only the choice gets visibly wrong

    double relativeTime() const { return choice->ms / own.ms; }
    /// Whether it is a choice of its own to show and to type.
    bool isShown() const { return choice && !advised; }
};

HalfTime halfTime(const Report& report);

/// "Take 32 samples a pixel: about 50 % less time, and the error rises from 0.0100 to 0.0200."
std::string halfTimeSentence(const Report& report);

}  // namespace cost
