#include "comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "figures.hpp"

namespace cost {
namespace {

/// Less than this share of time or error is not worth a word.
constexpr double kNoticeable = 0.005;

bool isChance(const Estimate& difference, double noticeable) {
    return std::abs(difference.value) <= std::max(3 * difference.standardError, noticeable);
}

/// Whether a lever changes how many samples there are or which, not what one of them shows.
bool changesSamples(LeverKind kind) {
    return kind == LeverKind::samples || kind == LeverKind::integrator;
}

bool morePixelsAreWrong(const Measurement& cheap, const Measurement& accurate) {
    return std::abs(cheap.sameSamples.wrongPixels - accurate.sameSamples.wrongPixels) > kNoticeablePixels;
}

/// Whether a setting differs from the scene's own in the picture, and its error at the scene's own samples.
struct Outcome {
    bool differs = false;
    double error = 0;
};

/// Pictures that repeat bit for bit share the error of their few samples: on top of it comes what a setting gets wrong at these very samples. That a cheap
/// one may get a bright spark wrong and so have less noise is no merit, and that an accurate one shows it no fault.
Outcome deterministicOutcome(const Measurement& m, const Measurement& own, double ownError, double expectedError) {
    const double more = m.sameSamples.relMse - own.sameSamples.relMse;
    const double error = more < 0 ? std::max(ownError + more, 0.0) : expectedError;
    return {std::abs(more) > kNoticeable * std::max(error, ownError) || morePixelsAreWrong(m, own), error};
}

/// The mean difference of the pixels is worth a word and beyond three standard errors, or more pixels look wrong.
Outcome sampledOutcome(const Measurement& m, const Measurement& own, double expectedError) {
    const double noticeable = kNoticeable * std::max(m.error.relMse, own.error.relMse);
    return {!isChance(pairedDifference(m.error, own.error), noticeable) || morePixelsAreWrong(m, own), expectedError};
}

/// What more samples leave, the shift between the two, is the cheap one's error; the rest falls as their number.
Outcome noisyOutcome(const Measurement& m, const Measurement& own, bool isCheap, double ownError, double expectedError) {
    const double shift = m.shift.isSignificant() ? m.shift.value : 0;
    const double noticeable = kNoticeable * std::max(m.error.relMse, own.error.relMse);
    if (!isChance(pairedDifference(m.error, own.error), noticeable)) return {true, expectedError};
    const double without = ownError * ownError / (ownError + shift);
    return {shift > kNoticeable * ownError, isCheap || shift == 0 ? ownError + shift : without};
}

Outcome outcomeOf(const std::vector<Lever>& levers, const std::vector<Measurement>& singles, size_t at, size_t lever,
                  double moreSamples) {
    const Measurement& m = singles[at];
    const Measurement& own = singles[0];
    const double ownError = expectedError(levers, singles, own, moreSamples);
    const double error = expectedError(levers, singles, m, moreSamples);
    const bool isCheap = m.configuration[lever] < levers[lever].initial;
    const bool random = own.bias.standardError > 0;
    Outcome outcome = random                               ? noisyOutcome(m, own, isCheap, ownError, error)
                      : changesSamples(levers[lever].kind) ? sampledOutcome(m, own, error)
                                                           : deterministicOutcome(m, own, ownError, error);
    // Of few pixels chance alone could be the difference, but that more samples have less noise needs no proof.
    if (levers[lever].kind == LeverKind::samples && (isCheap ? error > ownError : error < ownError)) outcome = {true, error};
    if (!outcome.differs) outcome.error = ownError;
    return outcome;
}

Spread inverse(const Spread& s) {
    return {1 / s.median, 1 / s.upper, 1 / s.lower};
}

/// Fills what follows from the errors of a comparison of which a difference was measured.
void compareErrors(const Measurement& cheap, const Measurement& accurate, Comparison& c) {
    c.removed = 1 - c.errorAccurate / std::max(c.errorCheap, 1e-30);
    c.change = c.removed >= 0 ? ErrorChange::less : ErrorChange::more;
    c.wrongPixels = std::max(cheap.sameSamples.wrongPixels - accurate.sameSamples.wrongPixels, 0.0);
    c.usefulness += std::log(std::max(c.errorCheap, 1e-12) / std::max(c.errorAccurate, 1e-12));
}

Comparison compareSettings(const std::vector<Lever>& levers, const std::vector<Measurement>& singles, size_t at, size_t lever,
                           double moreSamples) {
    Comparison c;
    const size_t own = levers[lever].initial;
    const size_t other = singles[at].configuration[lever];
    c.lever = lever;
    c.cheap = std::min(own, other);
    c.accurate = std::max(own, other);
    c.measurement = at;
    c.sceneHasAccurate = other < own;
    c.relativeTime = singles[at].slowdown;
    c.slowdown = c.sceneHasAccurate ? inverse(c.relativeTime) : c.relativeTime;
    c.usefulness = measurable(c.slowdown) ? -std::log(c.slowdown.median) : 0;
    const double ownError = expectedError(levers, singles, singles[0], moreSamples);
    const Outcome outcome = outcomeOf(levers, singles, at, lever, moreSamples);
    c.errorCheap = c.sceneHasAccurate ? outcome.error : ownError;
    c.errorAccurate = c.sceneHasAccurate ? ownError : outcome.error;
    if (outcome.differs) compareErrors(singles[c.sceneHasAccurate ? at : 0], singles[c.sceneHasAccurate ? 0 : at], c);
    return c;
}

std::string capitalised(std::string text) {
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

/// "costs", "cost" of several, "would cost" of what the scene does not have.
std::string verb(const Lever& lever, const Comparison& c, const std::string& one, const std::string& several) {
    return c.sceneHasAccurate ? lever.plural ? several : one : "would " + several;
}

/// The second verb of a sentence, of which "would" says the first.
std::string secondVerb(const Lever& lever, const Comparison& c, const std::string& word) {
    return word + (c.sceneHasAccurate && !lever.plural ? "s" : "");
}

std::string costPhrase(const Lever& lever, const Comparison& c) {
    const double time = c.relativeTime.median;
    const std::string range = timeRange(c.relativeTime);
    const std::string without = std::string("without ") + (lever.plural ? "them" : "it");
    const std::string cost = verb(lever, c, "costs", "cost");
    const bool longerByChance = c.sceneHasAccurate && time > 1 && !surelyDiffers(c.relativeTime);
    if (!measurable(c.relativeTime) || longerByChance) return verb(lever, c, "has", "have") + " no measurable cost";
    if (c.sceneHasAccurate && time < 1) return cost + " " + percent(1 - time) + " of the time" + range;
    const std::string longer = time < 2 ? percent(time - 1) + " longer" : number(time) + " times as long";
    if (c.sceneHasAccurate) return cost + " no time: " + without + " a picture takes " + longer + range + ",";
    if (time < 1) return "would save " + percent(1 - time) + " of the time" + range;
    return (time < 2 ? cost + " " + percent(time - 1) + " more time" : "would take " + longer) + range;
}

std::string errorPhrase(const Lever& lever, const Comparison& c, double floor) {
    const std::string figures =
        " (" + errorFigure(c.errorAccurate, floor) + " instead of " + errorFigure(c.errorCheap, floor) + ")";
    if (std::max(c.errorCheap, c.errorAccurate) <= floor)
        return secondVerb(lever, c, "change") + " less of the error than can be told (" + errorFigure(floor, floor) + ")";
    if (std::abs(c.removed) < kNoticeable) return secondVerb(lever, c, "change") + " little of the error";
    if (c.change == ErrorChange::less)
        return secondVerb(lever, c, "remove") + " " + percent(c.removed) + " of the error" + figures;
    if (c.removed > -1) return secondVerb(lever, c, "add") + " " + percent(-c.removed) + " to the error" + figures;
    return secondVerb(lever, c, "make") + " the error " + number(1 - c.removed) + " times as large" + figures;
}

std::string changePhrase(const Lever& lever, const Comparison& c, double floor) {
    if (c.change == ErrorChange::none) return secondVerb(lever, c, "change") + " nothing that could be measured in the picture";
    std::string phrase = errorPhrase(lever, c, floor);
    if (c.wrongPixels > kNoticeablePixels)
        phrase += std::string(c.change == ErrorChange::more ? " at so few samples, but " : "; ") +
                  (c.sceneHasAccurate ? "without " : "with ") + (lever.plural ? "them " : "it ") + percent(c.wrongPixels) +
                  " of the pixels visibly change";
    return phrase;
}

/// "4" of "4 samples", beside "8 samples".
std::string countAlone(const std::string& words) {
    return words.substr(0, words.find(' '));
}

}  // namespace

std::vector<Comparison> compareLevers(const std::vector<Lever>& levers, const std::vector<Measurement>& singles,
                                      double moreSamples) {
    const auto matters = [](const Comparison& a, const Comparison& b) { return std::abs(a.usefulness) > std::abs(b.usefulness); };
    // Of samples the next better number leads, which is the one to try first.
    const auto nearer = [](const Comparison& a, const Comparison& b) {
        const auto isBetter = [](const Comparison& c) { return !c.sceneHasAccurate && c.change == ErrorChange::less; };
        return isBetter(a) != isBetter(b) ? isBetter(a) : a.accurate - a.cheap < b.accurate - b.cheap;
    };
    std::vector<std::vector<Comparison>> groups;
    for (size_t lever = 0; lever < levers.size(); ++lever) {
        std::vector<Comparison> group;
        for (size_t at = 1; at < singles.size(); ++at)
            if (singles[at].configuration[lever] != levers[lever].initial)
                group.push_back(compareSettings(levers, singles, at, lever, moreSamples));
        if (group.empty()) continue;
        if (levers[lever].kind == LeverKind::samples)
            std::stable_sort(group.begin(), group.end(), nearer);
        else
            std::stable_sort(group.begin(), group.end(), matters);
        group.front().leading = true;
        groups.push_back(std::move(group));
    }
    std::stable_sort(groups.begin(), groups.end(), [&](const auto& a, const auto& b) { return matters(a.front(), b.front()); });
    std::vector<Comparison> all;
    for (const std::vector<Comparison>& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
}

bool measurable(const Spread& relativeTime) {
    return !covers(relativeTime, 1) && std::abs(relativeTime.median - 1) >= kNoticeable;
}

bool surelyDiffers(const Spread& relativeTime) {
    return measurable(relativeTime) &&
           std::abs(std::log(relativeTime.median)) > std::log(relativeTime.upper / relativeTime.lower);
}

std::string sentence(const Lever& lever, const Comparison& c, double floor) {
    const std::string& cheap = lever.settings[c.cheap].words;
    const bool counts = lever.plural && lever.kind != LeverKind::baked;
    const std::string subject =
        capitalised(lever.settings[c.accurate].words) + " instead of " + (counts ? countAlone(cheap) : cheap);
    if (c.change == ErrorChange::none && !measurable(c.relativeTime))
        return subject + " " + verb(lever, c, "makes", "make") +
               " no difference that could be measured, neither in time nor in the picture.";
    return subject + " " + costPhrase(lever, c) + " and " + changePhrase(lever, c, floor) + ".";
}

std::string idleSentence(const Lever& lever) {
    return lever.title + ": left alone, since " + lever.idle + ".";
}

std::string verdict(const Comparison& c) {
    const bool time = surelyDiffers(c.slowdown);
    const bool slower = time && c.slowdown.median > 1;
    if (c.change == ErrorChange::none) return !time ? "either" : slower ? "spare" : "keep";
    if (c.wrongPixels > kNoticeablePixels || c.change == ErrorChange::less) return !slower || c.usefulness > 0 ? "keep" : "trade";
    return slower || !time ? "spare" : "trade";
}

}  // namespace cost
