#include "study.hpp"

#include <algorithm>
#include <cmath>

#include "pareto.hpp"
#include "search.hpp"

namespace cost {
namespace {

// Shares of the time, in the order in which they are spent.
constexpr double kReferenceShare = 0.25;
constexpr double kSinglesShare = 0.4;

void choosePictureSize(const StudyOptions& options, const minirt_scene_desc& scene, Report& report) {
    constexpr double kPixels = 256.0 * 192.0;
    const double shape = static_cast<double>(scene.width) / scene.height;
    report.width = options.width ? options.width : static_cast<uint32_t>(std::lround(std::sqrt(kPixels * shape)));
    report.height = options.height ? options.height : static_cast<uint32_t>(std::lround(std::sqrt(kPixels / shape)));
}

std::vector<Lever> allLevers(const std::vector<Lever>& baked, const BlobFacts& facts, bool cpuDevice, uint32_t samples) {
    std::vector<Lever> levers = baked;
    for (Lever& lever : renderLevers(facts, cpuDevice, samples)) levers.push_back(std::move(lever));
    return levers;
}

/// The scene's, or the largest power of two below with which every lever gets its repeats in time.
uint32_t samplesInTime(const std::vector<Lever>& levers, double msPerSample, const StudyOptions& options, uint32_t own) {
    if (options.samples) return options.samples;
    constexpr double kSamplesLever = 6.75;  // a quarter, half, two and four times as many
    const double pictures = static_cast<double>(oneAtATime(levers).size()) + kSamplesLever;
    const double allowed = options.seconds * 1000 * kSinglesShare / (msPerSample * pictures * options.repeats);
    uint32_t samples = own;
    while (samples > allowed && samples > 1)
        samples = (samples & (samples - 1)) ? 1u << static_cast<uint32_t>(std::log2(samples)) : samples / 2;
    return samples;
}

/// Measured beside the scene's own settings again: what these took then and now tells how the device's speed has changed.
void addCombinations(Measurer& measurer, const StudyOptions& options, double deadline, Report& report) {
    std::vector<Configuration> configurations = combinations(report.levers, report.measurements, options.combinations);
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
        return measurer.measure({with(report.choice->configuration, findLever(levers, LeverKind::samples), 0)}, 3, 1e9).front();
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
    choosePictureSize(options, facts.scene, report);
    report.sceneSamples = facts.scene.samples;
    scenes.setLevers(allLevers(baked, facts, cpuDevice, 4));
    Measurer measurer(scenes, report.width, report.height, progress);
    const double msPerSample = measurer.warmUp(initialConfiguration(scenes.levers()));
    if (msPerSample <= 0) throw std::runtime_error(measurer.failures().front().reason);
    scenes.setLevers(
        allLevers(baked, facts, cpuDevice, samplesInTime(scenes.levers(), msPerSample, options, facts.scene.samples)));
    report.levers = scenes.levers();

    constexpr uint32_t kLeastHalf = 4;
    const double start = progress.seconds();
    const uint32_t own = samplesOf(report.levers, initialConfiguration(report.levers));
    measurer.makeReference(bestConfiguration(report.levers), options.seconds * kReferenceShare, std::max(kLeastHalf, 2 * own));
    const double left = options.seconds - (progress.seconds() - start);
    const double deadline = progress.seconds() + left * kSinglesShare / (1 - kReferenceShare);
    report.measurements = measurer.measure(oneAtATime(report.levers), options.repeats, deadline);
    report.singles = report.measurements.size();
    addCombinations(measurer, options, options.seconds, report);

    report.reference = measurer.reference();
    std::vector<Tradeoff> points;
    for (const Measurement& m : report.measurements) points.push_back({m.ms.median, m.error.relMse});
    report.front = paretoFront(points);
    const std::vector<Measurement> singles(report.measurements.begin(),
                                           report.measurements.begin() + static_cast<ptrdiff_t>(report.singles));
    report.comparisons = compareLevers(report.levers, singles, report.reference.random);
    if (options.budgetMs > 0) spendBudget(scenes, measurer, options, report);
    report.failures = measurer.failures();
    report.seconds = progress.seconds();
}

}  // namespace cost
