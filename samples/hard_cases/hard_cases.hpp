// Where rounding shows: small scenes, each with one figure and the bound that it must keep, baked and rendered with any setting of the accuracy levers.
#pragma once
#include <minirt.h>

#include <functional>
#include <string>
#include <vector>

#include "scene.hpp"

namespace hard_cases {

struct HardCaseResult {
    std::string name;
    std::string what;  // is looked at, in one line
    std::string unit;  // of figure and bound
    double figure = 0;
    double bound = 0;     // the figure may not be larger
    std::string failure;  // why there is no figure, or ""
    bool held() const { return failure.empty() && figure <= bound; }
};

/// Runs every case, or those whose name contains `only`. Takes about a second each; a case that cannot be baked or rendered says so and does not
/// hold. `context` must not be rendering.
std::vector<HardCaseResult> runHardCases(minirt_context* context, const minirtc::LeverSettings& levers,
                                         const std::string& only = "");

/// Called after each case with how many are done and how many there are, by one thread at a time.
using CaseProgress = std::function<void(size_t done, size_t all)>;

/// Runs every case with each of `settings`, and gives the results of each. A thread a context: contexts of the same device share the work.
std::vector<std::vector<HardCaseResult>> runHardCases(const std::vector<minirt_context*>& contexts,
                                                      const std::vector<minirtc::LeverSettings>& settings,
                                                      const CaseProgress& progress);

size_t countHeld(const std::vector<HardCaseResult>& results);

/// miniRTRender's settings: what the project started from.
minirtc::LeverSettings seedSettings();

}  // namespace hard_cases
