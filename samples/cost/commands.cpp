#include "commands.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace cost {
namespace {

std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

const Setting& settingOf(const Report& report, const BudgetChoice& choice, size_t lever) {
    return report.levers[lever].settings[choice.configuration[lever]];
}

/// What of a choice minirt-render has an option for. `all`: those too that a scene file has a key for.
std::string renderOptions(const Report& report, const BudgetChoice& choice, bool all) {
    std::string options;
    for (size_t i : changedLevers(report, choice)) {
        const LeverKind kind = report.levers[i].kind;
        const Setting& setting = settingOf(report, choice, i);
        if (kind == LeverKind::integrator) options += " --integrator " + setting.name;
        if (kind == LeverKind::cutoff) options += " --cutoff " + shortest(setting.value);
        if (kind == LeverKind::lightSampling) options += " --light-sampling " + setting.name;
        if (kind == LeverKind::depth && all) options += " --max-depth " + setting.name;
        if (kind == LeverKind::samples && all) options += " --spp " + std::to_string(choice.samples);
    }
    return options;
}

}  // namespace

std::string changesInWords(const Report& report, const BudgetChoice& choice) {
    const std::vector<size_t> changed = changedLevers(report, choice);
    std::string text;
    for (size_t i = 0; i < changed.size(); ++i) {
        text += i == 0 ? "" : i + 1 < changed.size() ? ", " : " and ";
        text += report.levers[changed[i]].kind == LeverKind::samples ? samplesWords(choice.samples)
                                                                     : settingOf(report, choice, changed[i]).words;
    }
    return text;
}

std::vector<size_t> changedLevers(const Report& report, const BudgetChoice& choice) {
    const Configuration& own = report.measurements.front().configuration;
    std::vector<size_t> changed;
    for (size_t i = 0; i < report.levers.size(); ++i) {
        const bool isSamples = report.levers[i].kind == LeverKind::samples;
        if (isSamples ? choice.samples != report.sceneSamples : choice.configuration[i] != own[i]) changed.push_back(i);
    }
    return changed;
}

std::vector<std::string> commandsFor(const Report& report, const BudgetChoice& choice) {
    std::vector<std::string> commands;
    std::string blob = report.file;
    if (report.baked) {
        blob = report.scene + ".mrt";
        std::string bake = "minirtc bake " + shellWord(report.file) + " -o " + shellWord(blob);
        for (size_t i : changedLevers(report, choice))
            if (report.levers[i].kind == LeverKind::baked)
                bake += " --set " + report.levers[i].name + "=" + settingOf(report, choice, i).name;
        commands.push_back(bake);
    }
    commands.push_back("minirt-render " + shellWord(blob) + " -o " + shellWord(report.scene + ".png") + report.deviceOption +
                       renderOptions(report, choice, true));
    return commands;
}

std::string sceneKeys(const Report& report, const BudgetChoice& choice) {
    if (!report.baked) return "";
    std::string keys;
    std::string accuracy;
    const auto add = [](std::string& list, const std::string& key, const std::string& value) {
        list += (list.empty() ? "\"" : ", \"") + key + "\": " + value;
    };
    for (size_t i : changedLevers(report, choice)) {
        const Lever& lever = report.levers[i];
        const Setting& setting = settingOf(report, choice, i);
        if (lever.kind == LeverKind::baked) add(accuracy, lever.name, "\"" + setting.name + "\"");
        if (lever.kind == LeverKind::depth) add(keys, "maxDepth", setting.name);
        if (lever.kind == LeverKind::samples) add(keys, "spp", std::to_string(choice.samples));
    }
    if (!accuracy.empty()) add(keys, "accuracy", "{" + accuracy + "}");
    return keys.empty() ? "" : "\"render\": {" + keys + "}";
}

std::string optionsBesideKeys(const Report& report, const BudgetChoice& choice) {
    return renderOptions(report, choice, false);
}

std::string shellWord(const std::string& word) {
    const auto harmless = [](unsigned char c) {
        return std::isalnum(c) || std::string("_-+=.,:/%@").find(c) != std::string::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), harmless)) return word;
    std::string quoted = "'";
    for (char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace cost
