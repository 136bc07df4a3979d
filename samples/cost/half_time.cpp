#include "half_time.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "commands.hpp"
#include "figures.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

constexpr double kHalf = 0.5;

/// With as many samples as the scene's own settings.
std::vector<size_t> atOwnSamples(const Report& report) {
    const size_t samples = findLever(report.levers, LeverKind::samples);
    std::vector<size_t> found;
    for (size_t i = 0; i < report.measurements.size(); ++i)
        if (report.measurements[i].configuration[samples] == report.levers[samples].initial) found.push_back(i);
    return found;
}

/// Of those that surely save enough to be worth a change and are not surely slower than the fastest, the most accurate.
std::optional<size_t> surelyFastest(const Report& report) {
    const auto time = [&](size_t i) -> const Spread& { return report.measurements[i].slowdown; };
    std::vector<size_t> faster = atOwnSamples(report);
    const auto drop = [&](const auto& slow) { faster.erase(std::remove_if(faster.begin(), faster.end(), slow), faster.end()); };
    drop([&](size_t i) { return !surelySaves(time(i)); });
    if (faster.empty()) return std::nullopt;
    const auto quicker = [&](size_t a, size_t b) { return time(a).median < time(b).median; };
    const Spread first = time(*std::min_element(faster.begin(), faster.end(), quicker));
    drop([&](size_t i) { return surelySlower(time(i), first); });
    const auto better = [&](size_t a, size_t b) { return report.errorOf(a) < report.errorOf(b); };
    return *std::min_element(faster.begin(), faster.end(), better);
}

/// By the levers of a measured configuration; not by its samples.
double wrongByLevers(const Report& report, const Configuration& configuration) {
    if (report.isOwnButSamples(configuration)) return 0;
    return moreWrongPixels(report, report.measurements[report.measurementOf(configuration)]);
}

/// Over the scene's own settings; what cannot be told from these takes as long.
double relativeTimeOf(const Measurement& m) {
    return covers(m.slowdown, 1) ? 1 : m.slowdown.median;
}

uint32_t samplesAtScene(const Report& report, const Measurement& m) {
    return report.samplesAtScene(samplesOf(report.levers, m.configuration));
}

/// Whether a measurement has the settings of a choice but for the samples.
bool hasSettingsOf(const Report& report, const Measurement& m, const BudgetChoice& choice) {
    const size_t samples = findLever(report.levers, LeverKind::samples);
    return with(m.configuration, samples, choice.configuration[samples]) == choice.configuration;
}

/// How many samples take a time with the scene's own settings: on a straight line between those that were measured, and to none.
double samplesWithin(const Report& report, double time) {
    std::map<double, double> timeWith = {{0, 0}};
    for (const Measurement& m : report.measurements)
        if (report.isOwnButSamples(m.configuration)) timeWith[samplesAtScene(report, m)] = relativeTimeOf(m);
    auto below = timeWith.begin();
    auto above = std::next(below);
    while (std::next(above) != timeWith.end() && above->second <= time) below = above++;
    if (above->second <= time) return above->first * time / above->second;
    return below->first + (above->first - below->first) * (time - below->second) / (above->second - below->second);
}

/// A choice with as many samples as fit half of the time by what was measured: of its own settings, and of how time grows with the samples. Nothing where not
/// even one fits.
std::optional<BudgetChoice> asMeasured(const Report& report, const BudgetChoice& own, const BudgetChoice& choice) {
    const size_t lever = findLever(report.levers, LeverKind::samples);
    const Measurement& base = report.measurements[report.measurementOf(choice.configuration)];
    const bool atOwnSamples = base.configuration[lever] == report.levers[lever].initial;
    double samples = atOwnSamples ? samplesWithin(report, kHalf / relativeTimeOf(base))
                                  : samplesAtScene(report, base) * kHalf / relativeTimeOf(base);
    for (const Measurement& m : report.measurements)
        if (hasSettingsOf(report, m, choice) && samplesAtScene(report, m) <= samples && relativeTimeOf(m) > kHalf)
            samples = samplesAtScene(report, m) * kHalf / relativeTimeOf(m);
    if (samples < 1) return std::nullopt;
    BudgetChoice fitting = expected(report.levers, report.measurements, base, static_cast<uint32_t>(samples));
    fitting.ms = own.ms * kHalf * fitting.samples / samples;
    return fitting;
}

/// The least error within half of the time.
std::optional<BudgetChoice> withinHalf(const Report& report, const BudgetChoice& own) {
    std::vector<BudgetChoice> fitting;
    for (const BudgetChoice& choice : choicesWithin(own.ms * kHalf, report.levers, report.measurements, 1))
        if (const std::optional<BudgetChoice> measured = asMeasured(report, own, choice)) fitting.push_back(*measured);
    return leastError(report.levers, fitting);
}

/// The measurement that fits half of the time with the settings of a choice and about as many samples.
std::optional<size_t> measuredLike(const Report& report, const BudgetChoice& choice) {
    constexpr double kAbout = 0.1;
    for (size_t i = 0; i < report.measurements.size(); ++i) {
        const Measurement& m = report.measurements[i];
        const double more = std::abs(static_cast<double>(samplesAtScene(report, m)) - choice.samples);
        if (relativeTimeOf(m) <= kHalf && hasSettingsOf(report, m, choice) && more <= kAbout * choice.samples) return i;
    }
    return std::nullopt;
}

/// With the figures of the tables.
BudgetChoice choiceOf(const Report& report, const BudgetChoice& own, size_t measurement) {
    const Measurement& m = report.measurements[measurement];
    return {m.configuration, samplesAtScene(report, m), own.ms * m.slowdown.median, report.errorOf(measurement)};
}

bool recommendedHalves(const Report& report) {
    return relativeTimeOf(report.measurements[recommended(report)]) <= kHalf;
}

}  // namespace

HalfTime halfTime(const Report& report) {
    HalfTime half;
    half.own = expected(report.levers, report.measurements, report.measurements.front(), report.sceneSamples);
    half.choice = withinHalf(report, half.own);
    half.measurement = half.choice ? measuredLike(report, *half.choice) : surelyFastest(report);
    half.fits = half.choice || (half.measurement && relativeTimeOf(report.measurements[*half.measurement]) <= kHalf);
    if (half.measurement) half.choice = choiceOf(report, half.own, *half.measurement);
    if (half.choice) half.wrongPixels = wrongByLevers(report, half.choice->configuration);
    half.advised = recommendedHalves(report) || half.measurement == recommended(report);
    return half;
}

std::string halfTimeSentence(const Report& report) {
    const HalfTime half = halfTime(report);
    if (!half.choice) return "Nothing that was measured halves the time, or surely saves " + percent(kLeastSaving) + " of it.";
    if (half.advised)
        return recommendedHalves(report) ? "The same: it halves the time already."
                                         : "Nothing that was measured halves the time; the same saves the most.";
    std::string text = half.fits ? "Take " : "Nothing that was measured halves the time. What surely saves the most is ";
    const std::string time = half.measurement ? timeDifference(report.measurements[*half.measurement].slowdown)
                                              : "about " + percent(1 - half.relativeTime()) + " less time";
    text += changesInWords(report, *half.choice) + ": " + time + ", and " +
            errorChange(half.own.relMse, half.choice->relMse, report.floor());
    if (half.wrongPixels > kNoticeablePixels)
        text += "; " + percent(half.wrongPixels) + " of the pixels visibly change, over the limit of " +
                percent(kNoticeablePixels) + " for a recommendation";
    return text + ".";
}

}  // namespace cost
