#include "half_time.hpp"

#include <algorithm>
#include <cmath>

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

/// Samples of a measurement, at the scene's own samples.
uint32_t samplesAtScene(const Report& report, const Measurement& m) {
    return static_cast<uint32_t>(std::lround(samplesOf(report.levers, m.configuration) * report.moreSamples()));
}

/// The measurement with the settings of a choice and about as many samples, where its time could be told from that of the scene's own settings.
std::optional<size_t> measurementOf(const Report& report, const BudgetChoice& choice) {
    constexpr double kAbout = 0.1;
    const size_t lever = findLever(report.levers, LeverKind::samples);
    for (size_t i = 0; i < report.measurements.size(); ++i) {
        const Measurement& m = report.measurements[i];
        const bool sameLevers = with(m.configuration, lever, choice.configuration[lever]) == choice.configuration;
        const double samples = samplesAtScene(report, m);
        if (sameLevers && measurable(m.slowdown) && std::abs(samples - choice.samples) <= kAbout * choice.samples) return i;
    }
    return std::nullopt;
}

/// Where the choice was measured, its figures are those of the tables.
void takeMeasured(const Report& report, HalfTime& half) {
    half.measurement = measurementOf(report, *half.choice);
    if (!half.measurement) return;
    const Measurement& m = report.measurements[*half.measurement];
    half.choice = {m.configuration, samplesAtScene(report, m), half.own.ms * m.slowdown.median,
                   report.errorOf(*half.measurement)};
}

/// Where what is recommended is what saves the most, too.
std::string advisedSentence(const Report& report, const HalfTime& half) {
    if (report.measurements[recommended(report)].slowdown.median <= 0.5) return "The same: it halves the time already.";
    return half.fits ? "The same: it nearly halves the time."
                     : "Nothing that was measured halves the time; the same saves the most.";
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
    if (!half.choice) return half;
    half.wrongPixels = wrongByLevers(report, half.choice->configuration);
    takeMeasured(report, half);
    half.advised = half.advised || (half.measurement && *half.measurement > 0 && *half.measurement == recommended(report));
    return half;
}

std::string halfTimeSentence(const Report& report) {
    const HalfTime half = halfTime(report);
    if (!half.choice) return "Nothing that was measured halves the time, or surely saves " + percent(kLeastSaving) + " of it.";
    if (half.advised) return advisedSentence(report, half);
    constexpr double kHalf = 0.52;
    std::string text = !half.fits                    ? "Nothing that was measured halves the time. What surely saves the most is "
                       : half.relativeTime() > kHalf ? "Nearly: take "
                                                     : "Take ";
    text += changesInWords(report, *half.choice) + (half.measurement ? ": " : ": about ") + percent(1 - half.relativeTime()) +
            " less time, and " + errorChange(half.own.relMse, half.choice->relMse, report.floor());
    if (half.wrongPixels > kNoticeablePixels)
        text += "; " + percent(half.wrongPixels) + " of the pixels visibly change, over the limit of " +
                percent(kNoticeablePixels) + " for a recommendation";
    return text + ".";
}

}  // namespace cost
