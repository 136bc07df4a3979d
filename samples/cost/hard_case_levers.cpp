#include "hard_case_levers.hpp"

#include <hard_cases.hpp>
#include <levers.hpp>

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

}  // namespace

std::vector<HardCases> runHardCases(const Device& device, Progress& progress) {
    std::vector<std::pair<std::string, minirtc::LeverSettings>> rows = {{"all at their defaults", {}}};
    for (const minirtc::Lever& lever : minirtc::levers()) {
        if (lever.when != minirtc::LeverTime::bake) continue;
        for (const minirtc::LeverSetting& setting : lever.settings)
            if (setting.name != lever.byDefault) rows.push_back({lever.name + " " + setting.name, {{lever.name, setting.name}}});
    }
    rows.push_back({"those of miniRTRender", hard_cases::seedSettings()});
    std::vector<HardCases> found;
    for (const auto& [name, settings] : rows) {
        progress.show("hard cases, " + name, found.size(), rows.size());
        found.push_back(summary(name, hard_cases::runHardCases(device.context(), settings)));
    }
    progress.clear();
    return found;
}

}  // namespace cost
