// Measures configurations: how long a picture takes and how wrong it is.
#pragma once
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "../common/spread.hpp"
#include "error_metrics.hpp"
#include "progress.hpp"
#include "rounds.hpp"
#include "scenes.hpp"

namespace cost {

/// Fewer say nothing about how far times spread.
constexpr uint32_t kLeastRounds = 3;

/// The accurate picture, as the mean of two halves whose noise is independent.
struct Reference {
    Configuration configuration;
    uint32_t samples = 0;  // of both halves
    bool random = false;   // path tracers: their noise is random; Whitted's pictures repeat bit for bit, but for roulette
    Picture firstHalf, secondHalf, mean;
    double relMse = 0;                      // its own error, from how much its halves differ
    std::map<uint32_t, Picture> atSamples;  // Whitted's: with the first so many samples a pixel
};

struct Measurement {
    Configuration configuration;
    uint32_t repeats = 0;
    Spread ms;        // of a picture: its dispatches, without the drift of whole rounds
    Spread slowdown;  // over the scene's own settings: of all pairs of repeats
    Errors error;     // against the reference; relMSE is the mean of the repeats
    Spread relMse;    // of the repeats
    Estimate bias;    // part of relMSE that more samples do not remove
    Estimate shift;   // of random pictures: the same against the scene's own settings, where like random numbers tell small ones
    Errors sameSamples;      // Whitted's: against the reference's settings at the same samples, which is the lever's own doing
    double pipelineMs = 0;   // LoadedScene::pipelineMs
    size_t kernelBytes = 0;  // of SPIR-V
    Picture picture;         // the mean of the repeats
};

/// The bias that is beyond doubt; 0 where none is. `own`: the scene's own settings; below them it is theirs that a shift adds to.
double systematicError(const Measurement& m, const Configuration& own);

/// The configuration that cannot be measured, and why.
struct Failure {
    Configuration configuration;
    std::string reason;
};

/// A picture takes so many times what the device does: it is fetched and compared.
constexpr double kBesideDevice = 1.5;

/// What Measurer::wake takes at most.
double wakeSeconds(const minirt_device_info& device);

struct TimedPicture {
    double ms = 0;
    double relMse = 0;
};

class Measurer {
public:
    Measurer(Scenes& scenes, uint32_t width, uint32_t height, Progress& progress)
        : scenes_(scenes), width_(width), height_(height), progress_(progress) {}

    /// Keeps a GPU busy for a while that has not rendered right before: it is slow at first.
    void wake(const Configuration& configuration);

    /// Milliseconds of the last of `times` pictures with one sample; 0 and a reason in failures() where it cannot be rendered. The first one teaches the
    /// runtime how much fits a dispatch.
    double warmUp(const Configuration& configuration, int times);

    /// As many samples as fit `seconds`, at least `least` a half. Throws std::runtime_error.
    void makeReference(const Configuration& configuration, double seconds, uint32_t least);
    const Reference& reference() const { return reference_; }

    /// Renders all of them in turn, in rounds, `repeats` times or until `deadline` of the progress's clock has passed, but kLeastRounds times if that many are asked for.
    /// The first one is what the others are compared with. What failed is left out.
    std::vector<Measurement> measure(const std::vector<Configuration>& configurations, uint32_t repeats, double deadline);

    /// Renders one picture and holds it against the reference. Throws std::runtime_error.
    TimedPicture once(const Configuration& configuration);

    const std::vector<Failure>& failures() const { return failures_; }

private:
    struct Tally;

    Picture render(const Configuration& configuration, uint32_t seed, uint32_t firstSample, uint32_t samples, double& ms);
    double add(Tally& tally, const Configuration& configuration, uint32_t round);
    Measurement evaluate(const Tally& tally, const Tally& own, const Configuration& configuration);
    const Picture& accurateAt(uint32_t samples);
    void takeAccuratePictures(const std::vector<Configuration>& configurations);

    Scenes& scenes_;
    uint32_t width_, height_;
    Progress& progress_;
    double lastRender_ = -1e9;  // by the clock of the progress
    Reference reference_;
    std::vector<Failure> failures_;
};

}  // namespace cost
