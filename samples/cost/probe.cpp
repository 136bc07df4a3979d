#include "probe.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "search.hpp"

namespace cost {
namespace {

/// Of one sample at the full size, once the device is warm.
double fullSizeMs(Scenes& scenes, const Configuration& configuration, uint32_t width, uint32_t height, Progress& progress) {
    return Measurer(scenes, width, height, progress).warmUp(configuration, 2);
}

std::vector<Measurement> measureSmall(Scenes& scenes, uint32_t width, uint32_t height, double budgetMs, Progress& progress) {
    constexpr double kPixels = 64.0 * 48.0;
    constexpr uint32_t kRounds = 2;
    constexpr size_t kCombinations = 4;
    const double scale = std::min(std::sqrt(kPixels / (static_cast<double>(width) * height)), 1.0);
    const auto scaled = [&](uint32_t side) { return std::max(static_cast<uint32_t>(std::lround(side * scale)), 1u); };
    const std::vector<Lever>& levers = scenes.levers();
    Measurer measurer(scenes, scaled(width), scaled(height), progress);
    measurer.makeReference(bestConfiguration(levers), std::clamp(budgetMs * 1e-3, 0.5, 3.0), 8);
    std::vector<Measurement> measurements = measurer.measure(oneAtATime(levers), kRounds, 0);
    std::vector<Configuration> more = combinations(levers, measurements, kCombinations);
    more.insert(more.begin(), initialConfiguration(levers));
    const std::vector<Measurement> found = measurer.measure(more, kRounds, 0);
    measurements.insert(measurements.end(), found.begin() + 1, found.end());
    return measurements;
}

}  // namespace

ProbedBudget probeBudget(Device& device, const std::string& blob, uint32_t width, uint32_t height, double budgetMs) {
    constexpr uint32_t kSamples = 2;
    constexpr int kAttempts = 4;
    constexpr double kMargin = 0.95;  // no two pictures take the same time
    const BlobFacts facts = readBlobFacts(blob);
    Scenes scenes(device, renderLevers(facts, device.info().is_cpu != 0, kSamples),
                  [&](const std::vector<Lever>&, const std::vector<Configuration>& configurations) {
                      return std::vector<std::string>(configurations.size(), blob);
                  });
    Progress progress;
    const std::vector<Measurement> small = measureSmall(scenes, width, height, budgetMs, progress);
    // Large pictures cost more or less for a pixel than small ones: what the first choice really takes corrects the next.
    const Lever& samples = scenes.levers()[findLever(scenes.levers(), LeverKind::samples)];
    double ratio = 0;
    for (const Measurement& m : small)
        if (m.configuration == initialConfiguration(scenes.levers()))
            ratio = fullSizeMs(scenes, m.configuration, width, height, progress) /
                    (m.ms.median / samples.settings[samples.initial].value);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        std::optional<BudgetChoice> choice = chooseWithin(budgetMs, scenes.levers(), small, ratio);
        if (!choice)
            throw std::runtime_error("--budget-ms: the fastest settings take " +
                                     std::to_string(static_cast<int>(std::ceil(fastestMs(scenes.levers(), small, ratio)))) +
                                     " ms on this device at this size; allow more, or make the picture smaller");
        const double ms = fullSizeMs(scenes, choice->configuration, width, height, progress);
        const double expected = choice->ms / choice->samples;
        if (ms <= budgetMs) {
            choice->samples = static_cast<uint32_t>(std::clamp(std::floor(kMargin * budgetMs / ms), 1.0, 2.0 * choice->samples));
            choice->ms = ms * choice->samples;
            progress.clear();
            return {scenes.levers(), *choice};
        }
        ratio *= ms / expected;
    }
    throw std::runtime_error(
        "--budget-ms: no settings keep within it on this device at this size; allow more, or make the picture smaller");
}

}  // namespace cost
