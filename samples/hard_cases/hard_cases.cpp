#include "hard_cases.hpp"

#include <algorithm>
#include <exception>

#include "cases.hpp"

namespace hard_cases {
namespace {

std::vector<HardCase> allCases() {
    std::vector<HardCase> all;
    for (const auto& part : {intersectionCases(), originCases(), opticsCases(), mediaCases()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

std::vector<HardCaseResult> runHardCases(minirt_context* context, const minirtc::LeverSettings& levers, const std::string& only) {
    const Stage stage(context, levers);
    std::vector<HardCaseResult> results;
    for (const HardCase& one : allCases()) {
        if (one.name.find(only) == std::string::npos) continue;
        HardCaseResult result{one.name, one.what, one.unit, 0, one.bound, ""};
        try {
            result.figure = one.figure(stage);
        } catch (const std::exception& error) {
            result.failure = error.what();
        }
        results.push_back(result);
    }
    return results;
}

size_t countHeld(const std::vector<HardCaseResult>& results) {
    return static_cast<size_t>(
        std::count_if(results.begin(), results.end(), [](const HardCaseResult& result) { return result.held(); }));
}

minirtc::LeverSettings seedSettings() {
    return {{"intersection", "moller_trumbore_epsilon"},
            {"ray_offset", "constant"},
            {"fresnel", "none"},
            {"nesting", "off"},
            {"absorption", "off"},
            {"dispersion", "off"}};
}

}  // namespace hard_cases
