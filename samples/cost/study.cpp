#include "study.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pareto.hpp"
#include "search.hpp"

namespace cost {
namespace {

// Shares of the time, in the order in which they are spent; bakes and pipelines get the rest.
constexpr double kReferenceShare = 0.3;
constexpr double kSinglesShare = 0.4;
constexpr double kPixels = 256.0 * 192.0;

/// The scene's shape with about `pixels`.
void setSize(const minirt_scene_desc& scene, double pixels, Report& report) {
    const double shape = static_cast<double>(scene.width) / scene.height;
    report.width = std::max(static_cast<uint32_t>(std::lround(std::sqrt(pixels * shape))), 1u);
    report.height = std::max(static_cast<uint32_t>(std::lround(std::sqrt(pixels / shape))), 1u);
}

std::vector<Lever> allLevers(const std::vector<Lever>& baked, const BlobFacts& facts, bool cpuDevice, uint32_t samples) {
    std::vector<Lever> levers = baked;
    for (Lever& lever : renderLevers(facts, cpuDevice, samples)) levers.push_back(std::move(lever));
    return levers;
}

/// Makes the picture smaller, then takes fewer samples than the scene's, until every lever gets its repeats in time. Returns the samples.
uint32_t fitWork(const std::vector<Lever>& levers, double msPerSample, const StudyOptions& options,
                 const minirt_scene_desc& scene, Report& report) {
    constexpr double kSamplesLever = 6.75;  // a quarter, half, two and four times as many
    constexpr uint32_t kEnough = 4;         // samples worth a smaller picture
    constexpr double kSmallest = 0.25;
    const double pictures = static_cast<double>(oneAtATime(levers).size()) + kSamplesLever;
    double allowed = options.seconds * 1000 * kSinglesShare / (msPerSample * pictures * options.repeats);
    const uint32_t wanted = options.samples ? options.samples : std::min(scene.samples, kEnough);
    if (!options.width && allowed < wanted) {
        const double scale = std::max(allowed / wanted, kSmallest);
        setSize(scene, kPixels * scale, report);
        allowed /= scale;
    }
    if (options.samples) return options.samples;
    uint32_t samples = scene.samples;
    while (samples > allowed && samples > 1) samples = samples % 2 ? samples - 1 : samples / 2;
    return samples;
}

/// Measured beside the scene's own settings again: what these took then and now tells how the device's speed has changed.
void addCombinations(Measurer& measurer, const StudyOptions& options, const Progress& progress, double deadline, Report& report) {
    const double msEach = report.measurements.front().ms.median * options.repeats * 1.5;  // more samples come with some of them
    const auto fitting = static_cast<size_t>(std::max((deadline - progress.seconds()) * 1000 / msEach, 4.0));
    std::vector<Configuration> configurations =
        combinations(report.levers, report.measurements, std::min(options.combinations, fitting));
    if (configurations.empty()) return;
    configurations.insert(configurations.begin(), initialConfiguration(report.levers));
    std::vector<Measurement> found = measurer.measure(configurations, options.repeats, deadline);
    const double faster = report.measurements.front().ms.median / found.front().ms.median;
    for (size_t i = 1; i < found.size(); ++i) {
        Spread& ms = found[i].ms;
        ms = {ms.median * faster, ms.lower * faster, ms.upper * faster};
        report.measurements.push_back(std::move(found[i]));
    }
}

/// Chooses, and measures what was chosen.
void spendBudget(Scenes& scenes, Measurer& measurer, const StudyOptions& options, Report& report) {
    report.budgetMs = options.budgetMs;
    report.choice = chooseWithin(options.budgetMs, report.levers, report.measurements, 1);
    if (!report.choice) return;
    std::vector<Lever> levers = report.levers;
    Lever& samples = levers[findLever(levers, LeverKind::samples)];
    const auto measured = [&](uint32_t count) {
        samples.settings = {{"", "", static_cast<double>(count)}};
        samples.initial = samples.best = 0;
        scenes.setLevers(levers);
        return measurer.measure({with(report.choice->configuration, findLever(levers, LeverKind::samples), 0)}, 1, 0).front();
    };
    Measurement m = measured(report.choice->samples);
    while (m.ms.median > options.budgetMs && report.choice->samples > 1) {
        const double fitting = report.choice->samples * options.budgetMs / m.ms.median;
        report.choice->samples = std::clamp(static_cast<uint32_t>(fitting), 1u, report.choice->samples - 1);
        m = measured(report.choice->samples);
    }
    scenes.setLevers(report.levers);
    report.choiceMs = m.ms.median;
    report.choiceRelMse = m.error.relMse;
}

}  // namespace

void study(Scenes& scenes, const BlobFacts& facts, bool cpuDevice, const StudyOptions& options, Progress& progress,
           Report& report) {
    const std::vector<Lever> baked = scenes.levers();
    report.sceneSamples = facts.scene.samples;
    setSize(facts.scene, kPixels, report);
    if (options.width) report.width = options.width, report.height = options.height;
    scenes.setLevers(allLevers(baked, facts, cpuDevice, 4));
    const double msPerSample =
        Measurer(scenes, report.width, report.height, progress).warmUp(initialConfiguration(scenes.levers()));
    const uint32_t samples = fitWork(scenes.levers(), std::max(msPerSample, 1e-3), options, facts.scene, report);
    scenes.setLevers(allLevers(baked, facts, cpuDevice, samples));
    report.levers = scenes.levers();

    Measurer measurer(scenes, report.width, report.height, progress);
    const double start = progress.seconds();
    measurer.makeReference(bestConfiguration(report.levers), options.seconds * kReferenceShare, std::max(4u, 2 * samples));
    report.measurements =
        measurer.measure(oneAtATime(report.levers), options.repeats, start + options.seconds * (kReferenceShare + kSinglesShare));
    report.singles = report.measurements.size();
    addCombinations(measurer, options, progress, start + options.seconds, report);

    report.reference = measurer.reference();
    std::vector<Tradeoff> points;
    for (const Measurement& m : report.measurements) points.push_back({m.ms.median, m.error.relMse});
    report.front = paretoFront(points);
    const std::vector<Measurement> singles(report.measurements.begin(),
                                           report.measurements.begin() + static_cast<ptrdiff_t>(report.singles));
    report.comparisons = compareLevers(report.levers, singles, static_cast<double>(report.sceneSamples) / samples);
    if (options.budgetMs > 0) spendBudget(scenes, measurer, options, report);
    report.failures = measurer.failures();
    report.seconds = progress.seconds();
}

}  // namespace cost
