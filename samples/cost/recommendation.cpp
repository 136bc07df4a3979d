#include "recommendation.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "figures.hpp"

namespace cost {
namespace {

constexpr double kMoreError = 0.05;         // that is accepted, as a share of the error of the scene's own settings
constexpr double kMoreWrongPixels = 0.002;  // likewise, as a share of all pixels
constexpr double kLeastSaving = 0.05;       // of the time, that is worth a change
constexpr double kSameTime = 0.02;          // of the time, for which it is not worth to change one setting more

/// How many times as many samples the scene takes by itself as were measured.
double moreSamples(const Report& report) {
    return static_cast<double>(report.sceneSamples) / report.samples();
}

/// relMSE at the scene's own samples. Whitted's pictures are taken at the same samples, where a setting that misses a bright spark has less noise by
/// being wrong: what it does at the same samples counts where it is more.
double expectedError(const Report& report, const Measurement& m) {
    const Measurement& own = report.measurements.front();
    if (!report.reference.random)
        return std::max(m.error.relMse, own.error.relMse + m.sameSamples.relMse - own.sameSamples.relMse);
    const double systematic = systematicError(m, own.configuration);
    return systematic + std::max(m.error.relMse - systematic, 0.0) / moreSamples(report);
}

double errorRatio(const Report& report, const Measurement& m) {
    return expectedError(report, m) / std::max(expectedError(report, report.measurements.front()), 1e-12);
}

bool keepsQuality(const Report& report, const Measurement& m) {
    const double wrong = m.sameSamples.wrongPixels - report.measurements.front().sameSamples.wrongPixels;
    return errorRatio(report, m) <= 1 + kMoreError && wrong <= kMoreWrongPixels;
}

bool savesTime(const Measurement& m) {
    return m.slowdown.upper <= 1 - kLeastSaving;
}

/// By more than both spread: what is the fastest by chance shuts out nothing else.
bool surelySlower(const Spread& slowdown, const Spread& fastest) {
    return slowdown.median > fastest.median * (1 + kSameTime) && slowdown.lower > fastest.upper;
}

std::vector<size_t> changedLevers(const Report& report, size_t measurement) {
    const Configuration& own = report.measurements.front().configuration;
    std::vector<size_t> changed;
    for (size_t i = 0; i < report.levers.size(); ++i)
        if (report.measurements[measurement].configuration[i] != own[i]) changed.push_back(i);
    return changed;
}

/// As the scene would be given them: the share of the samples that the setting takes of those measured.
uint32_t recommendedSamples(const Report& report, const Setting& setting) {
    return static_cast<uint32_t>(std::max(std::lround(setting.value * moreSamples(report)), 1L));
}

const Setting& settingOf(const Report& report, size_t lever) {
    return report.levers[lever].settings[report.measurements[recommended(report)].configuration[lever]];
}

std::string changesInWords(const Report& report, size_t measurement) {
    const std::vector<size_t> changed = changedLevers(report, measurement);
    std::string text;
    for (size_t i = 0; i < changed.size(); ++i) {
        const Lever& lever = report.levers[changed[i]];
        const Setting& setting = lever.settings[report.measurements[measurement].configuration[changed[i]]];
        const uint32_t samples = recommendedSamples(report, setting);
        text += i == 0 ? "" : i + 1 < changed.size() ? ", " : " and ";
        text += lever.kind == LeverKind::samples ? std::to_string(samples) + (samples == 1 ? " sample" : " samples") + " a pixel"
                                                 : setting.words;
    }
    return text;
}

std::string errorInWords(double ratio) {
    if (std::abs(ratio - 1) < 0.005) return "the same error";
    return percent(std::abs(ratio - 1)) + (ratio < 1 ? " less error" : " more error");
}

std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

/// What of the recommended settings minirt-render has an option for. `all`: those too that a scene file has a key for.
std::string renderOptions(const Report& report, bool all) {
    std::string options;
    for (size_t i : changedLevers(report, recommended(report))) {
        const LeverKind kind = report.levers[i].kind;
        const Setting& setting = settingOf(report, i);
        if (kind == LeverKind::integrator) options += " --integrator " + setting.name;
        if (kind == LeverKind::cutoff) options += " --cutoff " + shortest(setting.value);
        if (kind == LeverKind::lightSampling) options += " --light-sampling " + setting.name;
        if (kind == LeverKind::depth && all) options += " --max-depth " + setting.name;
        if (kind == LeverKind::samples && all) options += " --spp " + std::to_string(recommendedSamples(report, setting));
    }
    return options;
}

}  // namespace

size_t recommended(const Report& report) {
    std::vector<size_t> candidates;
    Spread fastest = {1, 1, 1};
    for (size_t i = 1; i < report.measurements.size(); ++i) {
        const Measurement& m = report.measurements[i];
        if (!savesTime(m) || !keepsQuality(report, m)) continue;
        candidates.push_back(i);
        if (m.slowdown.median < fastest.median) fastest = m.slowdown;
    }
    const auto slow = [&](size_t i) { return surelySlower(report.measurements[i].slowdown, fastest); };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), slow), candidates.end());
    const auto best = std::min_element(candidates.begin(), candidates.end(), [&](size_t a, size_t b) {
        const size_t changedA = changedLevers(report, a).size();
        const size_t changedB = changedLevers(report, b).size();
        const double timeA = report.measurements[a].slowdown.median;
        const double timeB = report.measurements[b].slowdown.median;
        return changedA != changedB ? changedA < changedB : timeA < timeB;
    });
    return best == candidates.end() ? 0 : *best;
}

std::string recommendationSentence(const Report& report) {
    const size_t choice = recommended(report);
    if (choice == 0)
        return "Keep the scene's own settings: nothing that was measured surely saves " + percent(kLeastSaving) +
               " of the time and keeps the quality of the picture.";
    const Measurement& m = report.measurements[choice];
    return "Take " + changesInWords(report, choice) + ": " + percent(1 - m.slowdown.median) + " less time (" +
           number(m.ms.median) + " instead of " + number(report.measurements.front().ms.median) + " ms a picture) and " +
           errorInWords(errorRatio(report, m)) + ".";
}

std::string recommendationRule(const Report& report) {
    std::string rule = "The rule: of the " + std::to_string(report.measurements.size()) +
                       " choices of settings that were measured, the fastest one that saves at least " + percent(kLeastSaving) +
                       " of the time in three quarters of all pairs of repeats, and whose error is at most " +
                       percent(kMoreError) + " larger than that of the scene's own settings";
    rule += report.reference.random ? ", as expected at the scene's " + std::to_string(report.sceneSamples) + " samples a pixel."
                                    : ", at the same samples as well, with at most " + percent(kMoreWrongPixels) +
                                          " more of the pixels visibly wrong there.";
    rule += " Of those that are slower than it by less than " + percent(kSameTime) +
            ", or by no more than the repeats spread, the one that changes the fewest settings";
    if (report.confirmed) rule += "; timed once more, since the fastest of many may be so by chance";
    return rule + ". It holds for this scene, this view and this device.";
}

std::vector<std::string> recommendedCommands(const Report& report) {
    std::vector<std::string> commands;
    std::string blob = report.file;
    if (report.baked) {
        blob = report.scene + ".mrt";
        std::string bake = "minirtc bake " + shellWord(report.file) + " -o " + shellWord(blob);
        for (size_t i : changedLevers(report, recommended(report)))
            if (report.levers[i].kind == LeverKind::baked)
                bake += " --set " + report.levers[i].name + "=" + settingOf(report, i).name;
        commands.push_back(bake);
    }
    commands.push_back("minirt-render " + shellWord(blob) + " -o " + shellWord(report.scene + ".png") + report.deviceOption +
                       renderOptions(report, true));
    return commands;
}

std::string recommendedKeys(const Report& report) {
    if (!report.baked) return "";
    std::string keys;
    std::string accuracy;
    const auto add = [](std::string& list, const std::string& key, const std::string& value) {
        list += (list.empty() ? "\"" : ", \"") + key + "\": " + value;
    };
    for (size_t i : changedLevers(report, recommended(report))) {
        const Lever& lever = report.levers[i];
        const Setting& setting = settingOf(report, i);
        if (lever.kind == LeverKind::baked) add(accuracy, lever.name, "\"" + setting.name + "\"");
        if (lever.kind == LeverKind::depth) add(keys, "maxDepth", setting.name);
        if (lever.kind == LeverKind::samples) add(keys, "spp", std::to_string(recommendedSamples(report, setting)));
    }
    if (!accuracy.empty()) add(keys, "accuracy", "{" + accuracy + "}");
    return keys.empty() ? "" : "\"render\": {" + keys + "}";
}

std::string recommendedOptionsBesideKeys(const Report& report) {
    return renderOptions(report, false);
}

std::string shellWord(const std::string& word) {
    const auto harmless = [](unsigned char c) {
        return std::isalnum(c) || std::string("_-+=.,:/%@").find(c) != std::string::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), harmless)) return word;
    std::string quoted = "'";
    for (char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace cost
