#include "search.hpp"

#include <algorithm>
#include <cmath>

namespace cost {
namespace {

/// One lever at another setting than the scene's, and what that did by itself, in logarithms.
struct Change {
    size_t lever = 0;
    size_t setting = 0;
    double time = 0;
    double error = 0;
};

std::vector<Change> changesOf(const std::vector<Comparison>& comparisons) {
    std::vector<Change> changes;
    changes.reserve(comparisons.size());
    for (const Comparison& c : comparisons)
        changes.push_back({c.lever, c.sceneHasAccurate ? c.cheap : c.accurate,
                           covers(c.relativeTime, 1) ? 0 : std::log(c.relativeTime.median),
                           std::log(std::max(c.errorThen(), 1e-12) / std::max(c.errorNow(), 1e-12))});
    return changes;
}

size_t changedLevers(const Configuration& configuration, const Configuration& own) {
    size_t count = 0;
    for (size_t i = 0; i < own.size(); ++i) count += configuration[i] != own[i] ? 1 : 0;
    return count;
}

/// Takes each lever's changes as they come, and drops those that gain less than one taken before.
void walk(const std::vector<Change>& changes, double Change::*gain, const Configuration& from, size_t most,
          std::vector<Configuration>& out) {
    Configuration at = from;
    std::vector<double> gained(from.size(), 0);
    for (const Change& change : changes) {
        const double gains = -(change.*gain);
        if (out.size() >= most || gains <= gained[change.lever]) continue;
        gained[change.lever] = gains;
        at[change.lever] = change.setting;
        out.push_back(at);
    }
}

}  // namespace

std::vector<Configuration> oneAtATime(const std::vector<Lever>& levers) {
    const Configuration own = initialConfiguration(levers);
    std::vector<Configuration> configurations = {own};
    for (size_t i = 0; i < levers.size(); ++i) {
        if (!levers[i].idle.empty()) continue;
        for (size_t s = 0; s < levers[i].settings.size(); ++s)
            if (s != levers[i].initial) configurations.push_back(with(own, i, s));
    }
    return configurations;
}

std::vector<Configuration> combinations(const std::vector<Lever>& levers, const std::vector<Comparison>& comparisons,
                                        size_t most) {
    constexpr double kSameError = 0.005;
    const Configuration own = initialConfiguration(levers);
    Configuration base = own;
    std::vector<double> saved(levers.size(), 0);
    std::vector<Change> finer;
    std::vector<Change> faster;
    for (const Change& change : changesOf(comparisons)) {
        if (change.time < 0 && change.error <= kSameError && change.time < saved[change.lever]) {
            saved[change.lever] = change.time;
            base[change.lever] = change.setting;
        }
        if (change.error < -kSameError) finer.push_back(change);
        if (change.time < 0 && change.error > kSameError) faster.push_back(change);
    }
    const auto perTime = [](const Change& c) { return -c.error / std::max(c.time, 1e-3); };
    const auto perError = [](const Change& c) { return -c.time / std::max(c.error, 1e-3); };
    std::sort(finer.begin(), finer.end(), [&](const Change& a, const Change& b) { return perTime(a) > perTime(b); });
    std::sort(faster.begin(), faster.end(), [&](const Change& a, const Change& b) { return perError(a) > perError(b); });
    std::vector<Configuration> found = {base};
    walk(finer, &Change::error, base, most / 2 + 1, found);
    walk(faster, &Change::time, base, most, found);
    std::vector<Configuration> fresh;
    for (const Configuration& c : found)
        if (changedLevers(c, own) > 1 && std::find(fresh.begin(), fresh.end(), c) == fresh.end()) fresh.push_back(c);
    return fresh;
}

size_t affordableCombinations(const Report& report, uint32_t repeats, double seconds) {
    // More samples come with some of them, and each with a blob of its own.
    const double each = report.prepareSeconds / static_cast<double>(report.pipelines) +
                        report.measurements.front().ms.median * repeats * kBesideDevice / 1000;
    return static_cast<size_t>(std::max((seconds - wakeSeconds(report.device)) / each, 0.0));
}

}  // namespace cost
