#include "budget.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cost {
namespace {

/// The part of the error that more samples remove.
double noiseOf(const Measurement& m, const Configuration& own) {
    return std::max(m.error.relMse - systematicError(m, own), 1e-12);
}

/// Pictures of path tracers, whose noise is random.
bool areRandom(const std::vector<Measurement>& measurements) {
    return measurements.front().bias.standardError > 0;
}

/// How fast noise falls with the samples: random noise as their number, 1; else the slope of a line through what the lever of the samples did, in logarithms.
double falloff(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements) {
    if (areRandom(measurements)) return 1;
    const size_t samples = findLever(levers, LeverKind::samples);
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Measurement& m : measurements) {
        if (with(m.configuration, samples, levers[samples].initial) != initialConfiguration(levers)) continue;
        const double u = std::log(samplesOf(levers, m.configuration));
        const double v = std::log(noiseOf(m, initialConfiguration(levers)));
        n += 1, x += u, y += v, xx += u * u, xy += u * v;
    }
    const double spread = n * xx - x * x;
    return spread > 0 ? std::clamp(-(n * xy - x * y) / spread, 0.25, 2.0) : 1.0;
}

/// What cannot be told from the time of the scene's own settings, `own`, counts as that: else the fastest by chance is chosen.
double msPerSample(const std::vector<Lever>& levers, const Measurement& m, const Measurement& own) {
    const double ms = covers(m.slowdown, 1) ? own.ms.median : m.ms.median;
    return ms / samplesOf(levers, m.configuration);
}

/// Both path tracers draw the same.
bool samePicture(const Lever& lever, size_t setting) {
    return lever.kind == LeverKind::integrator && lever.settings[setting].value != MINIRT_INTEGRATOR_WHITTED;
}

/// Whether the settings of `m` were measured with the scene's own samples too. These tell what other samples give: few ones have more noise, and many less,
/// than their number says, where a few bright sparks make most of it.
bool isMeasuredAtOwnSamples(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements,
                            const Measurement& m) {
    const size_t samples = findLever(levers, LeverKind::samples);
    const Configuration wanted = with(m.configuration, samples, levers[samples].initial);
    return std::any_of(measurements.begin(), measurements.end(), [&](const Measurement& o) { return o.configuration == wanted; });
}

/// Levers that differ from the scene's own settings, but for the samples, of which a budget decides.
size_t changes(const std::vector<Lever>& levers, const BudgetChoice& choice) {
    size_t count = 0;
    for (size_t i = 0; i < levers.size(); ++i)
        count += levers[i].kind != LeverKind::samples && choice.configuration[i] != levers[i].initial ? 1 : 0;
    return count;
}

}  // namespace

BudgetChoice expected(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements, const Measurement& m,
                      uint32_t samples) {
    const Configuration own = initialConfiguration(levers);
    const double slope = falloff(levers, measurements);
    const auto noiseAt = [&](const Measurement& of) {
        return noiseOf(of, own) * std::pow(static_cast<double>(samplesOf(levers, of.configuration)) / samples, slope);
    };
    // Where pictures are not random, all have the same noise, and what shows less of it misses bright sparks.
    const size_t lever = findLever(levers, LeverKind::samples);
    const bool ownButSamples = with(m.configuration, lever, own[lever]) == own;
    const double noise =
        areRandom(measurements) || ownButSamples ? noiseAt(m) : std::max(noiseAt(m), noiseAt(measurements.front()));
    const double ms = msPerSample(levers, m, measurements.front()) * samples;
    return {m.configuration, samples, ms, systematicError(m, own) + noise};
}

double expectedError(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements, const Measurement& m,
                     double moreSamples) {
    const long samples = std::lround(samplesOf(levers, m.configuration) * moreSamples);
    return expected(levers, measurements, m, static_cast<uint32_t>(std::max(samples, 1L))).relMse;
}

std::vector<BudgetChoice> choicesWithin(double ms, const std::vector<Lever>& levers, const std::vector<Measurement>& measurements,
                                        double pixelRatio) {
    constexpr double kMostSamples = 1 << 16;
    constexpr double kRounding = 1e-9;
    std::vector<BudgetChoice> choices;
    const size_t lever = findLever(levers, LeverKind::samples);
    for (const Measurement& m : measurements) {
        if (m.configuration[lever] != levers[lever].initial && isMeasuredAtOwnSamples(levers, measurements, m)) continue;
        const double perSample = msPerSample(levers, m, measurements.front()) * pixelRatio;
        const double samples = std::min(std::floor(ms / perSample + kRounding), kMostSamples);
        if (samples < 1) continue;
        choices.push_back(expected(levers, measurements, m, static_cast<uint32_t>(samples)));
        choices.back().ms *= pixelRatio;
    }
    return choices;
}

std::optional<BudgetChoice> leastError(const std::vector<Lever>& levers, const std::vector<BudgetChoice>& choices) {
    constexpr double kSameError = 0.02;
    double least = std::numeric_limits<double>::infinity();
    for (const BudgetChoice& choice : choices) least = std::min(least, choice.relMse);
    const auto best = std::min_element(choices.begin(), choices.end(), [&](const BudgetChoice& a, const BudgetChoice& b) {
        const bool goodA = a.relMse <= least * (1 + kSameError);
        const bool goodB = b.relMse <= least * (1 + kSameError);
        if (!goodA || !goodB) return goodA;
        return changes(levers, a) != changes(levers, b) ? changes(levers, a) < changes(levers, b) : a.relMse < b.relMse;
    });
    return best == choices.end() ? std::nullopt : std::optional(*best);
}

std::optional<BudgetChoice> chooseWithin(double ms, const std::vector<Lever>& levers,
                                         const std::vector<Measurement>& measurements, double pixelRatio) {
    return leastError(levers, choicesWithin(ms, levers, measurements, pixelRatio));
}

double fastestMs(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements, double pixelRatio) {
    double fastest = std::numeric_limits<double>::infinity();
    for (const Measurement& m : measurements) fastest = std::min(fastest, msPerSample(levers, m, measurements.front()));
    return fastest * pixelRatio;
}

std::string samplesWords(uint32_t samples) {
    return std::to_string(samples) + (samples == 1 ? " sample a pixel" : " samples a pixel");
}

std::string choiceWords(const std::vector<Lever>& levers, const BudgetChoice& choice) {
    std::string text = samplesWords(choice.samples);
    for (size_t i = 0; i < levers.size(); ++i)
        if (levers[i].kind != LeverKind::samples && choice.configuration[i] != levers[i].initial)
            text += ", " + levers[i].settings[choice.configuration[i]].words;
    return text;
}

std::vector<std::string> givenUp(const std::vector<Lever>& levers, const BudgetChoice& choice, uint32_t ownSamples) {
    std::vector<std::string> lost;
    for (size_t i = 0; i < levers.size(); ++i) {
        const Setting& own = levers[i].settings[levers[i].initial];
        if (levers[i].kind == LeverKind::samples) {
            if (choice.samples < ownSamples)
                lost.push_back(samplesWords(choice.samples) + " instead of " + std::to_string(ownSamples));
        } else if (choice.configuration[i] < levers[i].initial && !samePicture(levers[i], choice.configuration[i])) {
            lost.push_back(levers[i].settings[choice.configuration[i]].words + " instead of " + own.words);
        }
    }
    return lost;
}

std::string givenUpSentence(const std::vector<Lever>& levers, const BudgetChoice& choice, uint32_t ownSamples) {
    const std::vector<std::string> lost = givenUp(levers, choice, ownSamples);
    if (lost.empty()) return "Nothing is given up.";
    std::string text = "Given up: ";
    for (size_t i = 0; i < lost.size(); ++i) text += (i ? ", " : "") + lost[i];
    return text + ".";
}

}  // namespace cost
