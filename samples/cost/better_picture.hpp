// How much of the error is for want of samples, and what makes the picture better.
#pragma once
#include "report.hpp"

namespace cost {

/// Share of the error of the scene's own settings that more samples reduce: noise of path tracers, of Whitted's tracer what too few samples miss.
double samplingShare(const Report& report);

/// The least number of samples above the scene's own by which the error was seen to fall, or null.
const Comparison* moreSamples(const Report& report);

/// The settings that betterPictureSentence() names, together; nothing where it names none.
std::optional<BudgetChoice> betterPicture(const Report& report);

/// "Take exact Fresnel: 2 % more time, and the error falls from 0.0500 to 0.0100. 90 % of the error is noise of 4 samples a pixel; ..."
std::string betterPictureSentence(const Report& report);

}  // namespace cost
