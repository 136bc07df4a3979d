#include "half_time.hpp"

#include <algorithm>

#include "commands.hpp"
#include "figures.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

/// With as many samples as the scene's own settings.
std::vector<const Measurement*> atOwnSamples(const Report& report) {
    const size_t samples = findLever(report.levers, LeverKind::samples);
    std::vector<const Measurement*> found;
    for (const Measurement& m : report.measurements)
        if (m.configuration[samples] == report.levers[samples].initial) found.push_back(&m);
    return found;
}

const Measurement& quickest(const std::vector<const Measurement*>& measurements) {
    const auto quicker = [](const Measurement* a, const Measurement* b) { return a->slowdown.median < b->slowdown.median; };
    return **std::min_element(measurements.begin(), measurements.end(), quicker);
}

/// Of those that surely save enough to be worth a change and are not surely slower than the fastest, the most accurate.
std::optional<BudgetChoice> surelyFastest(const Report& report) {
    std::vector<const Measurement*> faster = atOwnSamples(report);
    const auto drop = [&](const auto& slow) { faster.erase(std::remove_if(faster.begin(), faster.end(), slow), faster.end()); };
    drop([](const Measurement* m) { return m->slowdown.upper > 1 - kLeastSaving; });
    if (faster.empty()) return std::nullopt;
    const Spread first = quickest(faster).slowdown;
    drop([&](const Measurement* m) { return surelySlower(m->slowdown, first); });
    const auto better = [](const Measurement* a, const Measurement* b) { return a->error.relMse < b->error.relMse; };
    return expected(report.levers, report.measurements, **std::min_element(faster.begin(), faster.end(), better),
                    report.sceneSamples);
}

/// By the levers of a measured configuration; not by its samples.
double wrongByLevers(const Report& report, const Configuration& configuration) {
    const size_t samples = findLever(report.levers, LeverKind::samples);
    const Measurement& own = report.measurements.front();
    if (with(configuration, samples, own.configuration[samples]) == own.configuration) return 0;
    const auto measured = [&](const Measurement& m) { return m.configuration == configuration; };
    const auto found = std::find_if(report.measurements.begin(), report.measurements.end(), measured);
    return moreWrongPixels(report, *found);
}

std::string errorChange(double from, double to) {
    if (number(from) == number(to)) return "the error stays at " + number(from);
    return std::string("the error ") + (to > from ? "rises" : "falls") + " from " + number(from) + " to " + number(to);
}

}  // namespace

HalfTime halfTime(const Report& report) {
    HalfTime half;
    half.own = expected(report.levers, report.measurements, report.measurements.front(), report.sceneSamples);
    half.choice = chooseWithin(half.own.ms / 2, report.levers, report.measurements, 1);
    half.fits = half.choice.has_value();
    if (!half.fits) half.choice = surelyFastest(report);
    const BudgetChoice advice = recommendedChoice(report);
    const bool same = half.fits && advice.configuration == half.choice->configuration && advice.samples == half.choice->samples;
    half.advised = same || report.measurements[recommended(report)].slowdown.median <= 0.5;
    if (half.choice) half.wrongPixels = wrongByLevers(report, half.choice->configuration);
    return half;
}

std::string halfTimeSentence(const Report& report) {
    const HalfTime half = halfTime(report);
    if (!half.choice) return "Nothing that was measured halves the time, or surely saves " + percent(kLeastSaving) + " of it.";
    if (half.advised) return "This halves the time already.";
    std::string text =
        half.fits ? "To halve the time, take " : "Nothing that was measured halves the time. What surely saves the most is ";
    text += changesInWords(report, *half.choice) + (half.fits ? ": about " : ": ") + percent(1 - half.choice->ms / half.own.ms) +
            " less time, and " + errorChange(half.own.relMse, half.choice->relMse);
    if (report.samples() < report.sceneSamples) text += ", as expected at the scene's own samples";
    if (half.wrongPixels > kNoticeablePixels)
        text += "; " + percent(half.wrongPixels) + " of the pixels visibly change, more than a recommendation may";
    return text + ".";
}

}  // namespace cost
