// A lever's accurate setting against its cheap one, and what to say about it.
#pragma once
#include <string>
#include <vector>

#include "measure.hpp"

namespace cost {

/// Less than this share of the pixels is not worth a word.
constexpr double kNoticeablePixels = 0.002;

enum class ErrorChange { none, less, more };

/// One of the two is the scene's own setting.
struct Comparison {
    size_t lever = 0;
    size_t cheap = 0;  // settings of the lever
    size_t accurate = 0;
    size_t measurement = 0;  // of the setting that is not the scene's own
    bool leading = false;    // of its lever, the one for which the decision matters the most
    Spread slowdown;         // by the accurate setting
    ErrorChange change = ErrorChange::none;
    double removed = 0;      // share of the error that the accurate setting removes; negative: it adds
    double wrongPixels = 0;  // share of the pixels that the cheap setting alone gets visibly wrong; 0 where noise hides it
    double usefulness = 0;   // logarithm of how much more an accurate picture gets out of its time: 1 / (error * time)
};

/// Each setting that was measured against the scene's own, lever by lever, the most useful first. `singles`: as oneAtATime gave them. `moreSamples`: how
/// many times as many samples as measured the scene takes by itself; the errors of noisy pictures are expected for so many.
std::vector<Comparison> compareLevers(const std::vector<Lever>& levers, const std::vector<Measurement>& singles,
                                      double moreSamples);

/// Whether a measurement differs from `own`, of the scene's own settings, by more than chance and 2 %, in time or in error.
bool standsOut(const Measurement& m, const Measurement& own);

/// "Exact Fresnel instead of Schlick's Fresnel costs 2 % more time and removes 80 % of the error." The same words for the same numbers.
std::string sentence(const Lever& lever, const Comparison& comparison);

/// Of a lever that can change nothing: "Dispersion: left alone, since no medium disperses light."
std::string idleSentence(const Lever& lever);

/// What to do: "keep", "spare", "trade", "either".
std::string verdict(const Comparison& comparison);

/// The two to act on: a setting to keep and one to spare where there are such, else the two most useful. What everybody knows, that samples and
/// integrators matter, comes last.
std::vector<size_t> findings(const std::vector<Lever>& levers, const std::vector<Comparison>& comparisons);

}  // namespace cost
