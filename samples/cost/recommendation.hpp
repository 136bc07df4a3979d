// Which of the measured settings to take, and how to get them.
#pragma once
#include "report.hpp"

namespace cost {

/// The measurement to take in place of the scene's own settings; 0, which is these, where nothing is worth a change. Of the same figures always the same.
size_t recommended(const Report& report);

/// "Take Schlick's Fresnel: 27 % less time (180 instead of 247 ms a picture) and 1 % more error."
std::string recommendationSentence(const Report& report);

/// How recommended() decides, in words.
std::string recommendationRule(const Report& report);

/// What to type for the recommended settings, a line each: the bake where the scene is a file, and the rendering.
std::vector<std::string> recommendedCommands(const Report& report);

/// The same as keys of the scene file, such as "render": {"spp": 32}; "" where it comes from a blob or no key says it.
std::string recommendedKeys(const Report& report);

/// Options of minirt-render for what has no key, such as " --cutoff 0.0078125"; "" where there is none.
std::string recommendedOptionsBesideKeys(const Report& report);

/// A word as a shell takes it: in quotes where it holds more than letters, digits and harmless signs.
std::string shellWord(const std::string& word);

}  // namespace cost
