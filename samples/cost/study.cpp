#include "study.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "confirmation.hpp"
#include "pareto.hpp"
#include "search.hpp"
#include "spending.hpp"

namespace cost {
namespace {

// Shares of the time that bakes and pipelines leave; combinations get the rest.
constexpr double kReferenceShare = 0.25;
constexpr double kSinglesShare = 0.5;
constexpr double kConfirmationShare = 0.05;
constexpr double kPixels = 256.0 * 192.0;
constexpr double kLeastPixels = 64.0 * 48.0;

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

/// What the pictures of a study take, in seconds, by the samples of the scene's own settings.
struct Work {
    double perSample = 0;  // what grows with them
    double once = 0;       // what does not

    double seconds(double samples) const { return perSample * samples + once; }
    double samplesIn(double seconds) const { return (seconds - once) / perSample; }
};

uint32_t leastOfReference(uint32_t samples) {
    return std::max(4u, 2 * samples);
}

/// Of each lever alone and of the reference, from what a sample takes with the scene's own and with the most accurate settings.
Work workOf(size_t settings, uint32_t repeats, double ownMs, double bestMs) {
    constexpr double kSamplesLever = 6.75;  // a quarter, half, two and four times as many
    constexpr double kReference = 4 + 4;    // at least twice as many in both of its halves, and at the samples of each setting
    const auto n = static_cast<double>(settings);
    return {((n + kSamplesLever) * repeats * ownMs + kReference * bestMs) / 1000, (n * ownMs + 4 * bestMs) / 1000};
}

/// Makes the picture smaller, then takes fewer samples than the scene's, until `work` fits `seconds`. Returns the samples.
uint32_t fitWork(const Work& work, double seconds, const StudyOptions& options, const minirt_scene_desc& scene, Report& report) {
    constexpr uint32_t kEnough = 4;  // samples worth a smaller picture
    const uint32_t wanted = options.samples ? options.samples : std::min(scene.samples, kEnough);
    double scale = 1;
    if (!options.width) {
        scale = std::clamp(seconds / work.seconds(wanted), kLeastPixels / kPixels, 1.0);
        setSize(scene, kPixels * scale, report);
    }
    if (options.samples) return options.samples;
    const double allowed = work.samplesIn(seconds / scale);
    uint32_t samples = scene.samples;
    while (samples > allowed && samples > 1) samples = samples % 2 ? samples - 1 : samples / 2;
    return samples;
}

/// A lever whose settings all end in the same kernels cannot change anything.
void findIdle(Scenes& scenes) {
    std::vector<Lever> levers = scenes.levers();
    const Configuration own = initialConfiguration(levers);
    for (size_t i = 0; i < levers.size(); ++i) {
        if (levers[i].kind != LeverKind::baked || !levers[i].idle.empty()) continue;
        bool same = true;
        for (size_t s = 0; s < levers[i].settings.size(); ++s) same = same && scenes.share(own, with(own, i, s));
        if (!same) continue;
        levers[i].idle = "the kernels are the same with all of its settings";
        levers[i].best = levers[i].initial;
    }
    scenes.setLevers(std::move(levers));
}

/// All blobs and pipelines that the reference and each lever alone need.
void prepareSingles(Scenes& scenes, Progress& progress) {
    std::vector<Configuration> configurations = oneAtATime(scenes.levers());
    configurations.push_back(bestConfiguration(scenes.levers()));
    progress.show("baking, pipelines", 0, configurations.size());
    scenes.prepare(configurations);
    findIdle(scenes);
}

/// Chooses the size of the picture, and how many samples the scene's own settings take.
uint32_t chooseWork(Scenes& scenes, const BlobFacts& facts, const StudyOptions& options, Progress& progress, Report& report) {
    setSize(facts.scene, kPixels, report);
    if (options.width) report.width = options.width, report.height = options.height;
    Measurer measurer(scenes, report.width, report.height, progress);
    const std::vector<Lever>& levers = scenes.levers();
    measurer.wake(initialConfiguration(levers));
    const double ownMs = std::max(measurer.warmUp(initialConfiguration(levers), 2), 1e-3);
    const double bestMs = std::max(measurer.warmUp(bestConfiguration(levers), 2), ownMs);
    const Work work = workOf(oneAtATime(levers).size(), options.repeats, ownMs, bestMs);
    const double left = (options.seconds - progress.seconds()) * (kReferenceShare + kSinglesShare);
    return fitWork(work, std::max(left, 0.0), options, facts.scene, report);
}

/// Measures beside the scene's own settings again: what these took then and now tells how the device's speed has changed. What fails is left out.
std::vector<Measurement> measureAgain(Measurer& measurer, std::vector<Configuration> configurations, uint32_t repeats,
                                      double deadline, const Report& report) {
    configurations.insert(configurations.begin(), initialConfiguration(report.levers));
    std::vector<Measurement> found = measurer.measure(configurations, repeats, deadline);
    const double faster = report.measurements.front().ms.median / found.front().ms.median;
    found.erase(found.begin());
    for (Measurement& m : found) m.ms = {m.ms.median * faster, m.ms.lower * faster, m.ms.upper * faster};
    return found;
}

/// Ends by `deadline`, of the progress's clock.
void addCombinations(Measurer& measurer, const StudyOptions& options, double deadline, const Progress& progress, Report& report) {
    const size_t fitting = affordableCombinations(report, options.repeats, deadline - progress.seconds());
    std::vector<Configuration> configurations =
        combinations(report.levers, report.comparisons, std::min(options.combinations, fitting));
    if (configurations.empty()) return;
    for (Measurement& m : measureAgain(measurer, std::move(configurations), options.repeats, deadline, report))
        report.measurements.push_back(std::move(m));
}

void confirm(Measurer& measurer, const StudyOptions& options, const Progress& progress, Report& report) {
    const auto again = [&](const Configuration& configuration, uint32_t rounds) -> std::optional<Measurement> {
        const std::vector<Measurement> found = measureAgain(measurer, {configuration}, rounds, options.seconds, report);
        return found.empty() ? std::nullopt : std::optional(found.front());
    };
    confirmRecommendation(
        again, options.repeats, [&] { return options.seconds - progress.seconds(); }, report);
}

void spend(Scenes& scenes, Measurer& measurer, const StudyOptions& options, const Progress& progress, Report& report) {
    std::vector<Lever> levers = report.levers;
    const size_t samplesLever = findLever(levers, LeverKind::samples);
    const auto render = [&](const Configuration& configuration, uint32_t samples) {
        levers[samplesLever].settings = {{"", "", static_cast<double>(samples)}};
        levers[samplesLever].initial = levers[samplesLever].best = 0;
        scenes.setLevers(levers);
        return measurer.once(with(configuration, samplesLever, 0));
    };
    spendBudget(
        render, [&] { return options.seconds - progress.seconds(); }, report);
    scenes.setLevers(report.levers);
}

}  // namespace

void study(Scenes& scenes, const BlobFacts& facts, bool cpuDevice, const StudyOptions& options, Progress& progress,
           Report& report) {
    StudyOptions measuring = options;
    measuring.seconds -= secondsToSpend(options.budgetMs, options.seconds);
    const size_t bakedLevers = scenes.levers().size();
    report.sceneSamples = facts.scene.samples;
    scenes.setLevers(allLevers(scenes.levers(), facts, cpuDevice, 4));
    prepareSingles(scenes, progress);
    report.prepareSeconds = progress.seconds();
    report.pipelines = scenes.count();
    const std::vector<Lever> baked(scenes.levers().begin(), scenes.levers().begin() + static_cast<ptrdiff_t>(bakedLevers));
    const uint32_t samples = chooseWork(scenes, facts, measuring, progress, report);
    scenes.setLevers(allLevers(baked, facts, cpuDevice, samples));
    report.levers = scenes.levers();

    Measurer measurer(scenes, report.width, report.height, progress);
    const double start = progress.seconds();
    report.budgetMs = options.budgetMs;
    const double left = std::max(measuring.seconds - start, 0.0);
    measurer.makeReference(bestConfiguration(report.levers), left * kReferenceShare, leastOfReference(samples));
    report.measurements =
        measurer.measure(oneAtATime(report.levers), options.repeats, start + left * (kReferenceShare + kSinglesShare));
    report.singles = report.measurements.size();
    report.compareSingles();
    addCombinations(measurer, measuring, start + left * (1 - kConfirmationShare), progress, report);
    report.reference = measurer.reference();
    report.nameSamples();
    confirm(measurer, measuring, progress, report);
    report.front = surelyOnFront(report);
    if (options.budgetMs > 0) spend(scenes, measurer, options, progress, report);
    report.failures = measurer.failures();
    report.seconds = progress.seconds();
}

}  // namespace cost
