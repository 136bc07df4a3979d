#include "better_picture.hpp"

#include <algorithm>
#include <cmath>

#include "action.hpp"
#include "figures.hpp"

namespace cost {
namespace {

constexpr double kMostOfTheError = 0.5;  // share from which on what reduces it is worth saying

std::string timeInWords(const Comparison& c) {
    return measurable(c.relativeTime) ? timeDifference(c.relativeTime) : "no more time";
}

/// With its time and what it does to the error.
std::string effectInWords(const Report& report, const Comparison& c) {
    const bool hidden = report.levers[c.lever].kind == LeverKind::samples && !measurable(c.relativeTime);
    return report.nameOf(c.measurement) + ": " + (hidden ? "more time, how much could not be told" : timeInWords(c)) + ", and " +
           errorChange(report.errorOf(0), c.errorThen(), report.floor());
}

/// How much more a picture gets out of its time by what was tried, as Comparison::usefulness.
double gain(const Comparison& c) {
    return c.sceneHasAccurate ? -c.usefulness : c.usefulness;
}

/// The most useful setting that is worth its time, or null.
const Comparison* bestUpgrade(const Report& report) {
    const Comparison* best = nullptr;
    for (const Comparison& c : report.comparisons)
        if (isUpgrade(report, c) && (!best || gain(c) > gain(*best))) best = &c;
    return best;
}

std::string shareSentence(const Report& report) {
    const double share = samplingShare(report);
    const std::string samples = samplesWords(report.sceneSamples);
    return (share > 0.99 ? "Nearly all" : percent(share)) + " of the error (" + errorFigure(report.errorOf(0), report.floor()) +
           ") is " + (report.reference.random ? "the noise of " : "jagged edges and missed detail of ") + samples;
}

}  // namespace

double samplingShare(const Report& report) {
    const Measurement& own = report.measurements.front();
    const double error = report.errorOf(0);
    if (error <= 0) return 0;
    return std::max(error - systematicError(own, own.configuration), 0.0) / error;
}

const Comparison* moreSamples(const Report& report) {
    const Comparison* least = nullptr;
    for (const Comparison& c : report.comparisons)
        if (report.levers[c.lever].kind == LeverKind::samples && !c.sceneHasAccurate && c.change == ErrorChange::less &&
            (!least || c.accurate < least->accurate))
            least = &c;
    return least;
}

std::optional<BudgetChoice> betterPicture(const Report& report) {
    const Comparison* upgrade = bestUpgrade(report);
    const Comparison* samples = samplingShare(report) < kMostOfTheError ? nullptr : moreSamples(report);
    if (!upgrade && !samples) return std::nullopt;
    BudgetChoice choice = {report.measurements.front().configuration, report.sceneSamples, 0, 0};
    if (upgrade) choice.configuration[upgrade->lever] = report.measurements[upgrade->measurement].configuration[upgrade->lever];
    if (samples) choice.samples = report.samplesAtScene(report.levers[samples->lever].settings[samples->accurate].value);
    return choice;
}

std::string betterPictureSentence(const Report& report) {
    const Comparison* upgrade = bestUpgrade(report);
    const Comparison* samples = moreSamples(report);
    std::string text = upgrade ? "Take " + effectInWords(report, *upgrade) + ". " : "";
    text += shareSentence(report);
    if (samplingShare(report) < kMostOfTheError) return text + ": more samples reduce no more than that.";
    text += ", which more samples reduce";
    return text + (samples ? ". With all else as it is, take " + effectInWords(report, *samples) + "." : ".");
}

}  // namespace cost
