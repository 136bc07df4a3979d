// What to type for a choice of settings.
#pragma once
#include "report.hpp"

namespace cost {

/// What differs from the scene's own settings, in words: "Schlick's Fresnel and 32 samples a pixel".
std::string changesInWords(const Report& report, const BudgetChoice& choice);

/// The levers that differ; the samples are held against the scene's own.
std::vector<size_t> changedLevers(const Report& report, const BudgetChoice& choice);

/// A line each: the bake where the scene is a file, and the rendering.
std::vector<std::string> commandsFor(const Report& report, const BudgetChoice& choice);

/// The same as keys of the scene file, such as "render": {"spp": 32}; "" where it comes from a blob or no key says it.
std::string sceneKeys(const Report& report, const BudgetChoice& choice);

/// Options of minirt-render for what has no key, such as " --cutoff 0.0078125"; "" where there is none.
std::string optionsBesideKeys(const Report& report, const BudgetChoice& choice);

/// A word as a shell takes it: in quotes where it holds more than letters, digits and harmless signs.
std::string shellWord(const std::string& word);

}  // namespace cost
