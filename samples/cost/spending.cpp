#include "spending.hpp"

#include <algorithm>

namespace cost {
namespace {

/// Of the choice, as many samples as fit the seconds, at least one.
uint32_t affordableSamples(const BudgetChoice& choice, double msPerSample, double seconds) {
    const double fitting = seconds * 1000 / (msPerSample * kBesideDevice);
    return static_cast<uint32_t>(std::clamp(fitting, 1.0, static_cast<double>(choice.samples)));
}

/// Fills what the report says of its choice. Returns the milliseconds.
double measureChoice(const RenderOnce& render, double seconds, Report& report) {
    const BudgetChoice& choice = *report.choice;
    report.choiceSamples = affordableSamples(choice, choice.ms / choice.samples, seconds);
    const TimedPicture picture = render(choice.configuration, report.choiceSamples);
    report.choiceMs = picture.ms * choice.samples / report.choiceSamples;
    report.choiceRelMse = report.choiceSamples < choice.samples ? choice.relMse : picture.relMse;
    return report.choiceMs;
}

/// The same settings with as many samples as fit the budget by what they took.
BudgetChoice fewerSamples(const Report& report) {
    const double fitting = report.choice->samples * report.budgetMs / report.choiceMs;
    const uint32_t samples = std::clamp(static_cast<uint32_t>(fitting), 1u, report.choice->samples - 1);
    const Measurement& measured = report.measurements[report.measurementOf(report.choice->configuration)];
    BudgetChoice choice = expected(report.levers, report.measurements, measured, samples);
    choice.ms = report.choiceMs * samples / report.choice->samples;
    return choice;
}

}  // namespace

double secondsToSpend(double budgetMs, double seconds) {
    constexpr double kMostShare = 0.2;
    constexpr double kAttempts = 2;
    return std::min(budgetMs / 1000 * kBesideDevice * kAttempts, kMostShare * seconds);
}

void spendBudget(const RenderOnce& render, const std::function<double()>& secondsLeft, Report& report) {
    report.choice = chooseWithin(report.budgetMs, report.levers, report.measurements, 1);
    if (!report.choice) return;
    while (measureChoice(render, secondsLeft(), report) > report.budgetMs && report.choice->samples > 1)
        report.choice = fewerSamples(report);
}

}  // namespace cost
