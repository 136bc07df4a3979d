#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>

#include "../common/wake.hpp"

namespace cost {
namespace {

/// Seeds of the reference are apart from those of the rounds.
constexpr uint32_t kReferenceSeed = 1u << 20;

/// The reference's samples of Whitted's tracer are none of those that are judged by it. A power of two, as the sequence asks for.
constexpr uint32_t kReferenceFirstSample = 1u << 14;

/// The scene's own settings, which all others are compared with, have another turn after so many of them.
constexpr size_t kOwnEvery = 6;

uint32_t floorToPowerOfTwo(double value) {
    uint32_t power = 1;
    while (power < (1u << 20) && 2.0 * power <= value) power *= 2;
    return power;
}

void accumulate(Picture& sum, const Picture& picture) {
    if (sum.rgba.empty()) {
        sum = picture;
        return;
    }
    for (size_t i = 0; i < sum.rgba.size(); ++i) sum.rgba[i] += picture.rgba[i];
}

Picture scaled(Picture picture, float factor) {
    for (float& value : picture.rgba) value *= factor;
    return picture;
}

}  // namespace

/// What the rounds of a configuration leave.
struct Measurer::Tally {
    std::vector<double> relMse;
    Errors errors;        // of all rounds, summed
    Picture even, odd;    // sums of the pictures of these rounds
    bool random = false;  // no two pictures are the same: of a path tracer, or where weak rays play roulette

    /// The means of the even and of the odd rounds; of a single round twice that.
    std::pair<Picture, Picture> halves() const {
        const size_t odds = relMse.size() / 2;
        const Picture mean = scaled(even, 1.0f / static_cast<float>(relMse.size() - odds));
        return {mean, odds ? scaled(odd, 1.0f / static_cast<float>(odds)) : mean};
    }
};

double systematicError(const Measurement& m, const Configuration& own) {
    if (m.bias.isSignificant()) return m.bias.value;
    const bool coarser = !std::equal(own.begin(), own.end(), m.configuration.begin(), [](size_t a, size_t b) { return a <= b; });
    return coarser && m.shift.isSignificant() ? m.shift.value : 0;
}

double wakeSeconds(const minirt_device_info& device) {
    return device.is_cpu ? 0 : kWakeMs / 1000;
}

Picture Measurer::render(const Configuration& configuration, uint32_t seed, uint32_t firstSample, uint32_t samples, double& ms) {
    minirt_render_desc desc = renderDesc(scenes_.levers(), configuration);
    desc.width = width_;
    desc.height = height_;
    desc.seed = seed;
    desc.first_sample = firstSample;
    desc.samples = samples;
    minirt_stats stats = {};
    desc.stats = &stats;
    Picture picture{width_, height_, std::vector<float>(size_t{width_} * height_ * 4)};
    const LoadedScene& loaded = scenes_.load(configuration);
    loaded.device->require(minirt_render(loaded.scene, &desc, picture.rgba.data()), "");
    ms = stats.gpu_ms;
    lastRender_ = progress_.seconds();
    return picture;
}

void Measurer::wake(const Configuration& configuration) {
    constexpr double kAwakeSeconds = 0.2;
    if (scenes_.onCpu() || progress_.seconds() - lastRender_ < kAwakeSeconds) return;
    runFor(kWakeMs, [&] { return warmUp(configuration, 1); });
}

double Measurer::warmUp(const Configuration& configuration, int times) {
    double ms = 0;
    try {
        for (int i = 0; i < times; ++i) render(configuration, 0, 0, 1, ms);
    } catch (const std::exception& error) {
        failures_.push_back({configuration, error.what()});
        return 0;
    }
    return ms;
}

void Measurer::makeReference(const Configuration& configuration, double seconds, uint32_t least) {
    constexpr uint32_t kMost = 1u << 13;
    const double msPerSample = warmUp(configuration, 2);
    if (msPerSample <= 0) throw std::runtime_error("the reference cannot be rendered: " + failures_.back().reason);
    const uint32_t half = std::clamp(floorToPowerOfTwo(seconds * 500 / msPerSample), least, kMost);
    const size_t integrator = findLever(scenes_.levers(), LeverKind::integrator);
    reference_.configuration = configuration;
    reference_.samples = 2 * half;
    reference_.random = scenes_.levers()[integrator].settings[configuration[integrator]].value != MINIRT_INTEGRATOR_WHITTED;
    double ms = 0;
    progress_.show("reference", 0, 2);
    reference_.firstHalf = render(configuration, kReferenceSeed, kReferenceFirstSample, half, ms);
    progress_.show("reference", 1, 2);
    const uint32_t second = kReferenceFirstSample + (reference_.random ? 0 : half);
    reference_.secondHalf = render(configuration, kReferenceSeed + 1, second, half, ms);
    reference_.mean = meanOf(reference_.firstHalf, reference_.secondHalf);
    reference_.relMse = relMseOfMean(reference_.firstHalf, reference_.secondHalf);
}

const Picture& Measurer::accurateAt(uint32_t samples) {
    const auto next = reference_.atSamples.lower_bound(samples);
    if (next != reference_.atSamples.end() && next->first == samples) return next->second;
    const uint32_t known = next == reference_.atSamples.begin() ? 0 : std::prev(next)->first;
    double ms = 0;
    Picture picture = render(reference_.configuration, 0, known, samples - known, ms);
    if (known > 0) {
        const float share = static_cast<float>(known) / static_cast<float>(samples);
        picture = scaled(std::move(picture), 1 - share);
        accumulate(picture, scaled(std::prev(next)->second, share));
    }
    return reference_.atSamples[samples] = std::move(picture);
}

void Measurer::takeAccuratePictures(const std::vector<Configuration>& configurations) {
    std::set<uint32_t> counts;  // ascending, so that each goes on from the one before
    for (const Configuration& c : configurations) counts.insert(samplesOf(scenes_.levers(), c));
    for (const uint32_t count : counts) accurateAt(count);
}

double Measurer::add(Tally& tally, const Configuration& configuration, uint32_t round) {
    double ms = 0;
    const Picture picture = render(configuration, round, 0, samplesOf(scenes_.levers(), configuration), ms);
    if (round <= 1) tally.random = reference_.random || (round == 1 && picture.rgba != tally.even.rgba);
    if (!tally.random && round > 0) {  // the same picture again
        tally.relMse.push_back(tally.relMse.front());
        return ms;
    }
    const Errors errors = compare(picture, reference_.mean);
    tally.relMse.push_back(errors.relMse);
    tally.errors.wrongPixels += errors.wrongPixels;
    tally.errors.ofPixels.resize(errors.ofPixels.size());
    for (size_t p = 0; p < errors.ofPixels.size(); ++p) tally.errors.ofPixels[p] += errors.ofPixels[p];
    tally.errors.largest = std::max(tally.errors.largest, errors.largest);
    accumulate(round % 2 ? tally.odd : tally.even, picture);
    return ms;
}

Measurement Measurer::evaluate(const Tally& tally, const Tally& own, const Configuration& configuration) {
    Measurement m;
    m.configuration = configuration;
    m.repeats = static_cast<uint32_t>(tally.relMse.size());
    m.relMse = spreadOf(tally.relMse);
    const uint32_t pictures = tally.random ? m.repeats : 1;
    m.error = tally.errors;
    m.error.wrongPixels /= pictures;
    for (float& error : m.error.ofPixels) error /= static_cast<float>(pictures);
    for (double relMse : tally.relMse) m.error.relMse += relMse / static_cast<double>(m.repeats);
    const auto [even, odd] = tally.random ? tally.halves() : std::pair(tally.even, tally.even);
    m.picture = meanOf(even, odd);
    if (reference_.random) {
        const auto [ownEven, ownOdd] = own.halves();
        m.bias.standardError = std::numeric_limits<double>::infinity();  // one picture tells nothing of it
        if (pictures > 1) {
            m.bias = squaredBias(even, odd, reference_.firstHalf, reference_.secondHalf, reference_.mean);
            m.shift = squaredBias(even, odd, ownEven, ownOdd, reference_.mean);
        }
    } else {
        const Picture& accurate = accurateAt(samplesOf(scenes_.levers(), configuration));
        m.sameSamples = compare(m.picture, accurate);
        if (pictures > 1) m.sameSamples.relMse = std::max(squaredBias(even, odd, accurate, accurate, accurate).value, 0.0);
        m.bias = {m.sameSamples.relMse, 0};
    }
    m.pipelineMs = scenes_.load(configuration).pipelineMs;
    m.kernelBytes = scenes_.load(configuration).kernelBytes;
    return m;
}

TimedPicture Measurer::once(const Configuration& configuration) {
    TimedPicture timed;
    const Picture picture = render(configuration, 0, 0, samplesOf(scenes_.levers(), configuration), timed.ms);
    timed.relMse = compare(picture, reference_.mean).relMse;
    return timed;
}

std::vector<Measurement> Measurer::measure(const std::vector<Configuration>& configurations, uint32_t repeats, double deadline) {
    scenes_.prepare(configurations);
    wake(configurations.front());
    std::vector<Configuration> running;
    for (const Configuration& c : configurations) {
        progress_.show("warming up", running.size(), configurations.size());
        if (warmUp(c, 1) > 0) running.push_back(c);
    }
    if (running.empty() || running.front() != configurations.front())
        throw std::runtime_error("the scene's own settings cannot be rendered: " + failures_.front().reason);
    if (!reference_.random) takeAccuratePictures(running);
    std::vector<Tally> tallies(running.size());
    std::vector<std::vector<Timing>> timings(running.size());
    uint32_t round = 0;
    for (; round < repeats && (round < kLeastRounds || progress_.seconds() < deadline); ++round) {
        for (size_t i = 0; i < running.size(); ++i) {
            progress_.show("round " + std::to_string(round + 1) + ", picture", i + 1, running.size());
            timings[i].push_back({round, add(tallies[i], running[i], round)});
            if (i % kOwnEvery != kOwnEvery - 1) continue;
            timings[0].emplace_back();
            timings[0].back().round = round;
            render(running[0], round, 0, samplesOf(scenes_.levers(), running[0]), timings[0].back().ms);
        }
    }
    removeDrift(timings, round);
    std::vector<Measurement> measurements;
    for (size_t i = 0; i < running.size(); ++i) {
        measurements.push_back(evaluate(tallies[i], tallies[0], running[i]));
        measurements.back().ms = spreadOf(millisecondsOf(timings[i]));
        measurements.back().slowdown = i == 0 ? Spread{1, 1, 1} : ratioOf(timings[i], timings[0]);
    }
    progress_.clear();
    return measurements;
}

}  // namespace cost
