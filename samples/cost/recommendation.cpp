#include "recommendation.hpp"

#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "figures.hpp"

namespace cost {
namespace {

constexpr double kMoreError = 0.05;  // that is accepted, as a share of the error of the scene's own settings

double errorRatio(const Report& report, size_t measurement) {
    return report.errorOf(measurement) / std::max(report.errorOf(0), 1e-12);
}

bool keepsQuality(const Report& report, size_t measurement) {
    return errorRatio(report, measurement) <= 1 + kMoreError &&
           moreWrongPixels(report, report.measurements[measurement]) <= kNoticeablePixels;
}

bool savesTime(const Measurement& m) {
    return m.slowdown.upper <= 1 - kLeastSaving;
}

BudgetChoice choiceOf(const Report& report, size_t measurement) {
    const Measurement& m = report.measurements[measurement];
    return {m.configuration, report.samplesAtScene(samplesOf(report.levers, m.configuration)), m.ms.median, m.error.relMse};
}

/// What would be recommended but for a few pixels: of these settings the one that changes the fewest. 0: none.
size_t nearestMiss(const Report& report) {
    constexpr double kFewPixels = 0.01;
    size_t nearest = 0;
    double least = kFewPixels;
    for (size_t i = 1; i < report.measurements.size(); ++i) {
        const Measurement& m = report.measurements[i];
        const double wrong = moreWrongPixels(report, m);
        if (!savesTime(m) || errorRatio(report, i) > 1 + kMoreError || wrong >= least) continue;
        nearest = i;
        least = wrong;
    }
    return nearest;
}

std::string nearestMissSentence(const Report& report, size_t miss) {
    const Measurement& m = report.measurements[miss];
    return " The closest that just fails is " + changesInWords(report, choiceOf(report, miss)) + ": " +
           timeDifference(m.slowdown) + ", but " + percent(moreWrongPixels(report, m)) +
           " of the pixels visibly change; the limit is " + percent(kNoticeablePixels) + ".";
}

}  // namespace

double moreWrongPixels(const Report& report, const Measurement& m) {
    return m.sameSamples.wrongPixels - report.measurements.front().sameSamples.wrongPixels;
}

bool savesForNothing(const Report& report, size_t measurement) {
    return savesTime(report.measurements[measurement]) && keepsQuality(report, measurement);
}

size_t recommended(const Report& report) {
    std::vector<size_t> candidates;
    Spread fastest = {1, 1, 1};
    for (size_t i = 1; i < report.measurements.size(); ++i) {
        const Measurement& m = report.measurements[i];
        if (!savesForNothing(report, i)) continue;
        candidates.push_back(i);
        if (m.slowdown.median < fastest.median) fastest = m.slowdown;
    }
    const auto slow = [&](size_t i) { return surelySlower(report.measurements[i].slowdown, fastest); };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), slow), candidates.end());
    const auto best = std::min_element(candidates.begin(), candidates.end(), [&](size_t a, size_t b) {
        const size_t changedA = changedLevers(report, choiceOf(report, a)).size();
        const size_t changedB = changedLevers(report, choiceOf(report, b)).size();
        const double timeA = report.measurements[a].slowdown.median;
        const double timeB = report.measurements[b].slowdown.median;
        return changedA != changedB ? changedA < changedB : timeA < timeB;
    });
    return best == candidates.end() ? 0 : *best;
}

BudgetChoice recommendedChoice(const Report& report) {
    return choiceOf(report, recommended(report));
}

std::string recommendationSentence(const Report& report) {
    const size_t choice = recommended(report);
    if (choice == 0) {
        const size_t miss = nearestMiss(report);
        return "Keep the scene's own settings: nothing that was measured surely saves " + percent(kLeastSaving) +
               " of the time and keeps the quality of the picture." + (miss ? nearestMissSentence(report, miss) : "");
    }
    return "Take " + changesInWords(report, choiceOf(report, choice)) + ": " +
           timeDifference(report.measurements[choice].slowdown) + ", and " +
           errorChange(report.errorOf(0), report.errorOf(choice), report.floor()) + ".";
}

std::string recommendationRule(const Report& report) {
    std::string rule = "Of the " + std::to_string(report.measurements.size()) +
                       " choices of settings that were measured, the fastest one that saves at least " + percent(kLeastSaving) +
                       " of the time in three quarters of all pairs of repeats, and whose error is at most " +
                       percent(kMoreError) + " larger than that of the scene's own settings";
    if (!report.reference.random)
        rule += ", with at most " + percent(kNoticeablePixels) + " more of the pixels looking wrong at the same samples";
    rule += ". Of those that are slower than it by less than " + percent(kSameTime) +
            ", or by no more than the repeats spread, the one that changes the fewest settings";
    if (report.confirmed) rule += "; timed once more, since the fastest of many may be so by chance";
    return rule + ". It holds for this scene, this view and this device.";
}

}  // namespace cost
