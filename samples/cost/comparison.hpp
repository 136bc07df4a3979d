// A lever's accurate setting against its cheap one, and what to say about it.
#pragma once
#include <string>
#include <vector>

#include "budget.hpp"

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
    bool leading = false;    // of its lever, the one for which the decision matters the most; of samples the next better number
    bool sceneHasAccurate = false;  // else the scene has the cheap one
    Spread slowdown;                // by the accurate setting
    Spread relativeTime;            // of the setting that is not the scene's own: 1 is the time of the scene's own
    double errorCheap = 0,
           errorAccurate = 0;  // relMSE at the scene's own samples; the same where no difference could be measured
    ErrorChange change = ErrorChange::none;
    double removed = 0;      // share of the error that the accurate setting removes; negative: it adds
    double wrongPixels = 0;  // share of the pixels that the cheap setting alone gets visibly wrong; 0 where noise hides it
    double usefulness = 0;   // logarithm of how much more an accurate picture gets out of its time: 1 / (error * time)

    /// The error of the scene's own setting, and of the other one.
    double errorNow() const { return sceneHasAccurate ? errorAccurate : errorCheap; }
    double errorThen() const { return sceneHasAccurate ? errorCheap : errorAccurate; }
};

/// Whether a time, over another, differs from it by more than chance and by enough to be worth a word.
bool measurable(const Spread& relativeTime);

/// Whether it is surely another time: it differs by more than the middle half of all pairs of repeats is wide. Of many settings that are compared, some differ by
/// less by chance.
bool surelyDiffers(const Spread& relativeTime);

/// Each setting that was measured against the scene's own, lever by lever, the most useful first. `singles`: as oneAtATime gave them. `moreSamples`: how
/// many times as many samples as measured the scene takes by itself; all errors are those expected for so many.
std::vector<Comparison> compareLevers(const std::vector<Lever>& levers, const std::vector<Measurement>& singles,
                                      double moreSamples);

/// "Exact Fresnel instead of Schlick's Fresnel costs 2 % of the time and removes 80 % of the error (0.0100 instead of 0.0500)." of a scene that has exact
/// Fresnel; of one that has Schlick's it "would cost 2 % more time". `floor`: the reference's own error. The same words for the same numbers.
std::string sentence(const Lever& lever, const Comparison& comparison, double floor);

/// Of a lever that can change nothing: "Dispersion: left alone, since no medium disperses light."
std::string idleSentence(const Lever& lever);

/// Whether the accurate setting is worth its time, whichever of the two the scene has: "keep", "spare", "trade", "either".
std::string verdict(const Comparison& comparison);

}  // namespace cost
