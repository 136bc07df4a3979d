#include "hard_case_levers.hpp"

#include <hard_cases.hpp>
#include <levers.hpp>

#include "bake_levers.hpp"
#include "figures.hpp"
#include "scenes.hpp"

namespace cost {
namespace {

HardCases summary(const std::string& settings, const std::vector<hard_cases::HardCaseResult>& results) {
    HardCases row{settings, 0, results.size(), {}};
    for (const hard_cases::HardCaseResult& result : results) {
        row.held += result.held() ? 1 : 0;
        if (result.held()) continue;
        const std::string figure = number(result.figure) + " " + result.unit + ", allowed " + number(result.bound);
        row.broken.push_back(result.what + " (" + (result.failure.empty() ? figure : result.failure) + ")");
    }
    return row;
}

/// The defaults, then each other setting of a lever of the bake alone, then miniRTRender's.
std::vector<std::pair<std::string, minirtc::LeverSettings>> allSettings() {
    std::vector<std::pair<std::string, minirtc::LeverSettings>> all = {{"all levers at their defaults", {}}};
    for (const minirtc::Lever& lever : minirtc::levers()) {
        if (lever.when != minirtc::LeverTime::bake) continue;
        for (const minirtc::LeverSetting& setting : lever.settings)
            if (setting.name != lever.byDefault) all.push_back({wordsOf(lever.name, setting.name), {{lever.name, setting.name}}});
    }
    all.push_back({"the settings of miniRTRender", hard_cases::seedSettings()});
    return all;
}

}  // namespace

std::vector<HardCases> runHardCases(const Device& device, Progress& progress) {
    std::vector<std::unique_ptr<Device>> others;
    std::vector<minirt_context*> contexts = {device.context()};
    while (contexts.size() < mostDevices()) {
        others.push_back(device.another());
        contexts.push_back(others.back()->context());
    }
    const auto all = allSettings();
    std::vector<minirtc::LeverSettings> settings;
    settings.reserve(all.size());
    for (const auto& [name, levers] : all) settings.push_back(levers);
    const auto results = hard_cases::runHardCases(contexts, settings,
                                                  [&](size_t done, size_t cases) { progress.show("hard cases", done, cases); });
    std::vector<HardCases> found;
    for (size_t i = 0; i < all.size(); ++i) found.push_back(summary(all[i].first, results[i]));
    progress.clear();
    return found;
}

}  // namespace cost
