#include "action.hpp"

#include <algorithm>
#include <cmath>

#include "better_picture.hpp"
#include "figures.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

/// What the setting that is tried does, against the scene's own.
struct Effect {
    bool faster = false, slower = false;
    bool better = false, worse = false;
    bool mixed = false;  // less error, but more pixels that are wrong, or the other way round
};

Effect effectOf(const Comparison& c) {
    Effect effect;
    const bool time = surelyDiffers(c.relativeTime);
    effect.faster = time && c.relativeTime.median < 1;
    effect.slower = time && c.relativeTime.median > 1;
    if (c.change == ErrorChange::none) return effect;
    const bool accurateIsBetter = c.change == ErrorChange::less || c.wrongPixels > kNoticeablePixels;
    effect.better = accurateIsBetter != c.sceneHasAccurate;
    effect.worse = !effect.better;
    effect.mixed = accurateIsBetter && c.change == ErrorChange::more;
    return effect;
}

bool isSamplesOrIntegrator(const Lever& lever) {
    return lever.kind == LeverKind::samples || lever.kind == LeverKind::integrator;
}

/// Of a setting that saves time for nothing.
Advice savingAdvice(const Report& report, const Comparison& c) {
    const Configuration& advised = report.measurements[recommended(report)].configuration;
    const bool taken = advised[c.lever] == report.measurements[c.measurement].configuration[c.lever];
    return taken ? Advice{Action::switchTo, "as good, and faster"} : Advice{Action::couldSwitch, "as good, but not the fastest"};
}

Advice sameErrorAdvice(const Comparison& c, const Effect& effect) {
    const Spread& time = c.relativeTime;
    if (effect.slower && time.lower >= 1 + kLeastSaving)
        return {c.sceneHasAccurate ? Action::keep : Action::notNeeded, "slower for nothing"};
    if (!measurable(time)) return {Action::hardlyMatters, "no measured difference"};
    if (time.median < 1) return {Action::hardlyMatters, "not surely " + percent(kLeastSaving) + " faster"};
    return {Action::hardlyMatters, effect.slower ? "a little slower" : "not surely slower"};
}

/// Where the better picture takes more time: whether the error changes by the larger factor decides.
Advice tradeAdvice(const Lever& lever, const Comparison& c, const Effect& effect) {
    const bool pays = verdict(c) == "keep" && !isSamplesOrIntegrator(lever);
    if (effect.better)
        return pays ? Advice{Action::upgrade, "gains more than it costs"} : Advice{Action::choose, "better, but slower"};
    if (c.relativeTime.median > 1 - kLeastSaving) return {Action::keep, "worse, and hardly faster"};
    return pays ? Advice{Action::keep, "loses more than it saves"} : Advice{Action::choose, "faster, but worse"};
}

/// Of more samples than the scene's own: the least number that is better comes first, and others where it does not do.
std::string whenToTakeSamples(const Report& report, const Comparison& c) {
    const Comparison* first = moreSamples(report);
    if (!first || c.accurate <= first->accurate) return "better, but slower";
    return "only if " + report.levers[c.lever].settings[first->accurate].words + " are too few";
}

/// By what a setting does to the picture, and what that takes.
Advice pictureAdvice(const Report& report, const Comparison& c) {
    const Effect effect = effectOf(c);
    if (!effect.better && !effect.worse) return sameErrorAdvice(c, effect);
    if (effect.mixed)
        return {Action::choose, effect.better ? "fewer wrong pixels, but more error" : "less error, but more wrong pixels"};
    const bool little = std::abs(c.removed) < kLeastSaving && c.wrongPixels <= kNoticeablePixels;
    if (effect.better && little && !isSamplesOrIntegrator(report.levers[c.lever]))
        return {Action::hardlyMatters, effect.slower ? "slower, and only a little better" : "only a little better"};
    // More samples take longer, also where an unsteady machine could not show it.
    if (effect.better && report.levers[c.lever].kind == LeverKind::samples) return {Action::choose, whenToTakeSamples(report, c)};
    if (effect.better && !effect.slower) return {Action::upgrade, "better, and not surely slower"};
    if (effect.worse && !effect.faster)
        return {c.sceneHasAccurate ? Action::keep : Action::notNeeded,
                effect.slower ? "worse, and slower" : "worse, and not surely faster"};
    return tradeAdvice(report.levers[c.lever], c, effect);
}

/// Numbers of the comparisons that lead their levers; of levers that everybody knows last.
std::vector<size_t> leadingOnes(const Report& report) {
    std::vector<size_t> order;
    for (const bool known : {false, true})
        for (size_t i = 0; i < report.comparisons.size(); ++i)
            if (report.comparisons[i].leading && isSamplesOrIntegrator(report.levers[report.comparisons[i].lever]) == known)
                order.push_back(i);
    return order;
}

/// Of the settings that are a choice, the time of the one that saves the most.
double mostTimeToChoose(const Report& report, const std::vector<size_t>& comparisons) {
    double least = 1;
    for (size_t i : comparisons) {
        const Comparison& c = report.comparisons[i];
        if (!isSamplesOrIntegrator(report.levers[c.lever]) && adviceOn(report, c).action == Action::choose)
            least = std::min(least, c.relativeTime.median);
    }
    return least;
}

}  // namespace

Advice adviceOn(const Report& report, const Comparison& c) {
    return savesForNothing(report, c.measurement) ? savingAdvice(report, c) : pictureAdvice(report, c);
}

bool isUpgrade(const Report& report, const Comparison& c) {
    return pictureAdvice(report, c).action == Action::upgrade;
}

std::string instruction(const Report& report, const Comparison& c) {
    const Lever& lever = report.levers[c.lever];
    const std::string& own = lever.settings[lever.initial].words;
    const std::string& other = lever.settings[c.sceneHasAccurate ? c.cheap : c.accurate].words;
    switch (adviceOn(report, c).action) {
        case Action::switchTo:
            return "Switch to " + other;
        case Action::couldSwitch:
            return "You could switch to " + other;
        case Action::upgrade:
            return "Upgrade to " + other;
        case Action::keep:
            return "Keep " + own;
        case Action::notNeeded:
            return "No need for " + other;
        case Action::choose:
            return "Your choice";
        case Action::hardlyMatters:
            break;
    }
    return "Hardly matters";
}

std::string actionWords(Action action) {
    const char* const words[] = {"switch", "could switch", "upgrade", "keep", "not needed", "your choice", "hardly matters"};
    return words[static_cast<size_t>(action)];
}

std::string actionName(Action action) {
    const char* const names[] = {"switch", "could-switch", "upgrade", "keep", "not-needed", "choose", "hardly-matters"};
    return names[static_cast<size_t>(action)];
}

std::vector<size_t> byAction(const Report& report) {
    std::vector<size_t> order(report.comparisons.size());
    std::vector<Action> leading(report.comparisons.size());
    for (size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
        leading[i] = report.comparisons[i].leading ? adviceOn(report, report.comparisons[i]).action : leading[i - 1];
    }
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return leading[a] < leading[b]; });
    return order;
}

std::vector<size_t> findings(const Report& report) {
    const std::vector<size_t> leading = leadingOnes(report);
    std::vector<size_t> chosen;
    const auto take = [&](const auto& fits) {
        for (size_t i : leading) {
            const bool taken = std::find(chosen.begin(), chosen.end(), i) != chosen.end();
            if (chosen.size() < 2 && !taken && fits(report.comparisons[i])) return chosen.push_back(i);
        }
    };
    const auto does = [&](const Comparison& c, Action action) { return adviceOn(report, c).action == action; };
    take([&](const Comparison& c) { return does(c, Action::switchTo); });
    take([&](const Comparison& c) { return does(c, Action::upgrade); });
    // What the scene does not do by itself it need not be told to do without.
    take([&](const Comparison& c) { return c.sceneHasAccurate && does(c, Action::keep); });
    const double most = mostTimeToChoose(report, leading);
    take([&](const Comparison& c) { return does(c, Action::choose) && c.relativeTime.median == most; });
    for (size_t i = 0; i < 2; ++i) take([](const Comparison&) { return true; });
    return chosen;
}

}  // namespace cost
