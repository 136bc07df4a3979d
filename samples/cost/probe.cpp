#include "probe.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "search.hpp"

namespace cost {
namespace {

constexpr uint32_t kSamples = 2;

/// A picture of the same shape that is small enough to try all settings in a second or so, but shows what they do.
void chooseSize(Scenes& scenes, uint32_t width, uint32_t height, Progress& progress, ProbedBudget& probed) {
    constexpr double kPixels = 64.0 * 48.0;
    constexpr double kLeastPixels = 32.0 * 24.0;
    constexpr double kMs = 10;  // a sample
    const auto take = [&](double pixels) {
        const double scale = std::min(std::sqrt(pixels / (static_cast<double>(width) * height)), 1.0);
        probed.width = std::max(static_cast<uint32_t>(std::lround(width * scale)), 1u);
        probed.height = std::max(static_cast<uint32_t>(std::lround(height * scale)), 1u);
    };
    take(kPixels);
    const double ms = Measurer(scenes, probed.width, probed.height, progress).warmUp(initialConfiguration(scenes.levers()), 1);
    if (ms > kMs) take(std::max(kPixels * kMs / ms, kLeastPixels));
}

std::vector<Measurement> measureSmall(Scenes& scenes, double budgetMs, Progress& progress, const ProbedBudget& probed) {
    constexpr uint32_t kRounds = 2;
    constexpr size_t kCombinations = 4;
    const std::vector<Lever>& levers = scenes.levers();
    Measurer measurer(scenes, probed.width, probed.height, progress);
    measurer.makeReference(bestConfiguration(levers), std::clamp(budgetMs * 1e-3, 0.25, 1.0), 2 * kSamples);
    std::vector<Measurement> measurements = measurer.measure(oneAtATime(levers), kRounds, 0);
    std::vector<Configuration> more = combinations(levers, compareLevers(levers, measurements, 1), kCombinations);
    more.insert(more.begin(), initialConfiguration(levers));
    const std::vector<Measurement> found = measurer.measure(more, kRounds, 0);
    measurements.insert(measurements.end(), found.begin() + 1, found.end());
    return measurements;
}

/// How many times as long a picture of the full size takes as the small one: large pictures cost more or less for a pixel. By the fastest settings, which
/// have to fit.
double fullOverSmall(Scenes& scenes, const std::vector<Measurement>& small, uint32_t width, uint32_t height, Progress& progress) {
    const auto smallMs = [&](const Measurement& m) { return m.ms.median / samplesOf(scenes.levers(), m.configuration); };
    const Measurement& fastest = *std::min_element(
        small.begin(), small.end(), [&](const Measurement& a, const Measurement& b) { return smallMs(a) < smallMs(b); });
    return Measurer(scenes, width, height, progress).warmUp(fastest.configuration, 1) / smallMs(fastest);
}

}  // namespace

ProbedBudget probeBudget(Device& device, const std::string& blob, uint32_t width, uint32_t height, double budgetMs) {
    constexpr int kAttempts = 4;
    constexpr double kMargin = 0.95;  // no two pictures take the same time
    const BlobFacts facts = readBlobFacts(blob);
    Scenes scenes(device, renderLevers(facts, device.info().is_cpu != 0, kSamples),
                  [&](const std::vector<Lever>&, const std::vector<Configuration>& configurations) {
                      return std::vector<std::string>(configurations.size(), blob);
                  });
    Progress progress;
    ProbedBudget probed;
    probed.levers = scenes.levers();
    probed.sceneSamples = facts.scene.samples;
    chooseSize(scenes, width, height, progress, probed);
    const std::vector<Measurement> small = measureSmall(scenes, budgetMs, progress, probed);
    probed.tried = small.size();
    double ratio = fullOverSmall(scenes, small, width, height, progress);
    // What a choice really takes at the full size corrects the next, until that is the same one.
    bool fits = false;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        std::optional<BudgetChoice> choice = chooseWithin(budgetMs, probed.levers, small, ratio);
        if (!choice && !fits)
            throw std::runtime_error("--budget-ms: the fastest settings take about " +
                                     std::to_string(static_cast<int>(std::ceil(fastestMs(probed.levers, small, ratio)))) +
                                     " ms on this device at this size; allow more, or make the picture smaller");
        if (!choice || (fits && choice->configuration == probed.choice.configuration)) break;
        const double ms = Measurer(scenes, width, height, progress).warmUp(choice->configuration, 1);
        ratio *= ms * choice->samples / choice->ms;
        if (ms > budgetMs) continue;
        fits = true;
        choice->samples = static_cast<uint32_t>(std::max(std::floor(kMargin * budgetMs / ms), 1.0));
        choice->ms = ms * choice->samples;
        probed.choice = *choice;
    }
    probed.seconds = progress.seconds();
    progress.clear();
    if (fits) return probed;
    throw std::runtime_error(
        "--budget-ms: no settings keep within it on this device at this size; allow more, or make the picture smaller");
}

}  // namespace cost
