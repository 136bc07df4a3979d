// What a time that was given buys, measured where there is time for it.
#pragma once
#include <functional>

#include "report.hpp"

namespace cost {

/// Renders a picture with settings and so many samples a pixel.
using RenderOnce = std::function<TimedPicture(const Configuration&, uint32_t samples)>;

/// Seconds to set aside for spendBudget out of those of a run.
double secondsToSpend(double budgetMs, double seconds);

/// Chooses what fits report.budgetMs, measures it, and takes fewer samples until it keeps to it. Of a picture that would take longer than `secondsLeft` only
/// as many samples are rendered as fit, at least one: the time is then scaled and the error as expected.
void spendBudget(const RenderOnce& render, const std::function<double()>& secondsLeft, Report& report);

}  // namespace cost
