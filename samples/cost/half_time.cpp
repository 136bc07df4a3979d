#include "half_time.hpp"

#include <algorithm>

#include "commands.hpp"
#include "figures.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

/// Of those that surely save time and are not surely slower than the fastest, the most accurate; as many samples as the scene takes.
std::optional<BudgetChoice> fastest(const Report& report) {
    const size_t samples = findLever(report.levers, LeverKind::samples);
    std::vector<const Measurement*> faster;
    for (const Measurement& m : report.measurements)
        if (m.slowdown.upper < 1 && m.configuration[samples] == report.levers[samples].initial) faster.push_back(&m);
    if (faster.empty()) return std::nullopt;
    const auto quicker = [](const Measurement* a, const Measurement* b) { return a->slowdown.median < b->slowdown.median; };
    const Spread first = (*std::min_element(faster.begin(), faster.end(), quicker))->slowdown;
    const auto slow = [&](const Measurement* m) { return surelySlower(m->slowdown, first); };
    faster.erase(std::remove_if(faster.begin(), faster.end(), slow), faster.end());
    const auto better = [](const Measurement* a, const Measurement* b) { return a->error.relMse < b->error.relMse; };
    const Measurement& m = **std::min_element(faster.begin(), faster.end(), better);
    return expected(report.levers, report.measurements, m, report.sceneSamples);
}

std::string errorChange(const HalfTime& half) {
    const std::string own = number(half.own.relMse);
    const std::string chosen = number(half.choice->relMse);
    if (own == chosen) return "the error stays at " + own;
    return std::string("the error ") + (half.choice->relMse > half.own.relMse ? "rises" : "falls") + " from " + own + " to " +
           chosen;
}

}  // namespace

HalfTime halfTime(const Report& report) {
    HalfTime half;
    half.own = expected(report.levers, report.measurements, report.measurements.front(), report.sceneSamples);
    half.choice = chooseWithin(half.own.ms / 2, report.levers, report.measurements, 1);
    half.fits = half.choice.has_value();
    if (!half.fits) half.choice = fastest(report);
    const BudgetChoice advice = recommendedChoice(report);
    half.advised = half.fits && advice.configuration == half.choice->configuration && advice.samples == half.choice->samples;
    for (const Measurement& m : report.measurements)
        if (half.choice && m.configuration == half.choice->configuration)
            half.wrongPixels = m.sameSamples.wrongPixels - report.measurements.front().sameSamples.wrongPixels;
    return half;
}

std::string halfTimeSentence(const Report& report) {
    const HalfTime half = halfTime(report);
    if (!half.choice) return "Nothing that was measured halves the time, or surely saves any.";
    if (half.advised) return "This halves the time already.";
    std::string text = half.fits ? "To halve the time, take " : "Nothing that was measured halves the time. The fastest is ";
    text += changesInWords(report, *half.choice) + ": " + percent(1 - half.choice->ms / half.own.ms) + " less time, and " +
            errorChange(half);
    if (report.samples() < report.sceneSamples) text += ", as expected at the scene's own samples";
    if (half.wrongPixels > kNoticeablePixels) text += "; with it " + percent(half.wrongPixels) + " of the pixels look wrong";
    return text + ".";
}

}  // namespace cost
