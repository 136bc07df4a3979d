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
        if (!surelySaves(m.slowdown) || errorRatio(report, i) > 1 + kMoreError || wrong >= least) continue;
        nearest = i;
        least = wrong;
    }
    return nearest;
}

/// What surely saves time for nothing, but for what is surely slower than the fastest of it.
std::vector<size_t> candidates(const Report& report) {
    std::vector<size_t> found;
    Spread fastest = {1, 1, 1};
    for (size_t i = 1; i < report.measurements.size(); ++i) {
        const Measurement& m = report.measurements[i];
        if (!savesForNothing(report, i)) continue;
        found.push_back(i);
        if (m.slowdown.median < fastest.median) fastest = m.slowdown;
    }
    const auto slow = [&](size_t i) { return surelySlower(report.measurements[i].slowdown, fastest); };
    found.erase(std::remove_if(found.begin(), found.end(), slow), found.end());
    return found;
}

/// Faster than what is recommended, or as fast with less error; and hardly higher in the plot than the scene's own settings.
bool looksAsGood(const Report& report, size_t measurement, size_t advised) {
    constexpr double kHardlyHigher = 2 * kMoreError;
    if (measurement == 0 || measurement == advised || errorRatio(report, measurement) > 1 + kHardlyHigher) return false;
    const double time = report.measurements[measurement].slowdown.median;
    const double advisedTime = report.measurements[advised].slowdown.median;
    const bool lessError = report.errorOf(measurement) < report.errorOf(advised);
    return time < advisedTime || (lessError && time <= advisedTime * (1 + kSameTime));
}

std::string nearestMissSentence(const Report& report, size_t miss) {
    const Measurement& m = report.measurements[miss];
    return " The closest that just fails is " + changesInWords(report, choiceOf(report, miss)) + ": " +
           timeDifference(m.slowdown) + ", but " + percent(moreWrongPixels(report, m)) +
           " of the pixels visibly change; the limit is " + percent(kNoticeablePixels) + ".";
}

}  // namespace

bool surelySaves(const Spread& slowdown) {
    return slowdown.upper <= 1 - kLeastSaving && surelyDiffers(slowdown);
}

double moreWrongPixels(const Report& report, const Measurement& m) {
    return m.sameSamples.wrongPixels - report.measurements.front().sameSamples.wrongPixels;
}

bool savesForNothing(const Report& report, size_t measurement) {
    return surelySaves(report.measurements[measurement].slowdown) && keepsQuality(report, measurement);
}

size_t recommended(const Report& report) {
    const std::vector<size_t> found = candidates(report);
    const auto best = std::min_element(found.begin(), found.end(), [&](size_t a, size_t b) {
        const size_t changedA = changedLevers(report, choiceOf(report, a)).size();
        const size_t changedB = changedLevers(report, choiceOf(report, b)).size();
        const double timeA = report.measurements[a].slowdown.median;
        const double timeB = report.measurements[b].slowdown.median;
        return changedA != changedB ? changedA < changedB : timeA < timeB;
    });
    return best == found.end() ? 0 : *best;
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

std::string whyNotRecommended(const Report& report, size_t measurement) {
    const size_t advised = recommended(report);
    if (!looksAsGood(report, measurement, advised)) return "";
    const Measurement& m = report.measurements[measurement];
    const double moreError = errorRatio(report, measurement) - 1;
    const double wrong = moreWrongPixels(report, m);
    if (moreError > kMoreError) return percent(moreError) + " more error (limit " + percent(kMoreError) + ")";
    if (wrong > kNoticeablePixels)
        return percent(wrong) + " of the pixels visibly change (limit " + percent(kNoticeablePixels) + ")";
    if (!surelySaves(m.slowdown)) return "not surely " + percent(kLeastSaving) + " faster than the scene's own settings";
    const std::vector<size_t> found = candidates(report);
    if (std::find(found.begin(), found.end(), measurement) == found.end()) return "as good, but not the fastest";
    return "a tie with what is recommended, which changes no more settings";
}

std::string recommendationRule(const Report& report) {
    std::string rule = "Of the " + std::to_string(report.measurements.size()) +
                       " choices of settings that were measured, the fastest one that saves at least " + percent(kLeastSaving) +
                       " of the time in three quarters of all pairs of repeats, and more than twice what these scatter, and "
                       "whose error is at most " +
                       percent(kMoreError) + " larger than that of the scene's own settings";
    if (!report.reference.random)
        rule += ", with at most " + percent(kNoticeablePixels) + " more of the pixels looking wrong at the same samples";
    rule += ". Of those that are slower than it by less than " + percent(kSameTime) +
            ", or by no more than the repeats spread, the one that changes the fewest settings";
    if (report.confirmed) rule += "; timed once more, since the fastest of many may be so by chance";
    return rule + ". It holds for this scene, this view and this device.";
}

}  // namespace cost
