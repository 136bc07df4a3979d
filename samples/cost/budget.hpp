// The most accurate settings that fit a time.
#pragma once
#include <optional>

#include "measure.hpp"

namespace cost {

struct BudgetChoice {
    Configuration configuration;  // but for the samples
    uint32_t samples = 0;
    double ms = 0;      // expected, of a picture as large as the measured ones times `pixelRatio`
    double relMse = 0;  // expected
};

/// What is expected of a measured configuration with so many samples a pixel: time grows with them, the bias stays, the rest of the error falls as
/// their number where it is random, else with a power of them that the lever of the samples shows.
BudgetChoice expected(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements, const Measurement& m,
                      uint32_t samples);

/// The error expected of a measured configuration with `moreSamples` times as many samples as measured.
double expectedError(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements, const Measurement& m,
                     double moreSamples);

/// All measured configurations, each with as many samples as fit `ms`, but for those of which not even one fits. `pixelRatio`: pixels of the picture that is
/// wanted over those of the measured ones.
std::vector<BudgetChoice> choicesWithin(double ms, const std::vector<Lever>& levers, const std::vector<Measurement>& measurements,
                                        double pixelRatio);

/// The choice with the least error expected; of those with about as little, the one that changes the fewest settings. Nothing of none.
std::optional<BudgetChoice> leastError(const std::vector<Lever>& levers, const std::vector<BudgetChoice>& choices);

/// The same of choicesWithin.
std::optional<BudgetChoice> chooseWithin(double ms, const std::vector<Lever>& levers,
                                         const std::vector<Measurement>& measurements, double pixelRatio);

/// Milliseconds of one sample with the fastest configuration.
double fastestMs(const std::vector<Lever>& levers, const std::vector<Measurement>& measurements, double pixelRatio);

/// "12 samples a pixel".
std::string samplesWords(uint32_t samples);

/// "12 samples a pixel, 8 bounces": the samples, and what differs from the scene's own settings.
std::string choiceWords(const std::vector<Lever>& levers, const BudgetChoice& choice);

/// What a choice gives up: "8 bounces instead of 16" for each lever under its own setting; the samples under `ownSamples`, the scene's, likewise. Empty: nothing.
std::vector<std::string> givenUp(const std::vector<Lever>& levers, const BudgetChoice& choice, uint32_t ownSamples);

/// The same in a sentence.
std::string givenUpSentence(const std::vector<Lever>& levers, const BudgetChoice& choice, uint32_t ownSamples);

}  // namespace cost
