// Which of the measured settings to take.
#pragma once
#include "report.hpp"

namespace cost {

constexpr double kLeastSaving = 0.05;  // of the time, that is worth a change

/// Whether a time over that of the scene's own settings is less by enough to be worth a change, and by more than the repeats scatter.
bool surelySaves(const Spread& slowdown);

/// Share of all pixels that look wrong by a measurement's settings alone, at the same samples; beyond kNoticeablePixels it is not recommended.
double moreWrongPixels(const Report& report, const Measurement& m);

/// Whether a measurement surely takes less time than the scene's own settings, by enough to be worth a change, and keeps the quality of the picture.
bool savesForNothing(const Report& report, size_t measurement);

/// The measurement to take in place of the scene's own settings; 0, which is these, where nothing is worth a change. Of the same figures always the same.
size_t recommended(const Report& report);

/// The same with as many samples a pixel as the scene would be given: the share of its own that the measurement takes of those measured.
BudgetChoice recommendedChoice(const Report& report);

/// "Take Schlick's Fresnel: 27 % less time, and the error rises from 0.0100 to 0.0104."
std::string recommendationSentence(const Report& report);

/// Why a measurement is not recommended that looks as good in the plot as what is, or better: "0.55 % of the pixels visibly change (limit 0.2 %)".
/// "" of all others.
std::string whyNotRecommended(const Report& report, size_t measurement);

/// How recommended() decides, in words.
std::string recommendationRule(const Report& report);

}  // namespace cost
