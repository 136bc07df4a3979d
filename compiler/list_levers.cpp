#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"

namespace minirtc {
namespace {

nlohmann::ordered_json describe(const Lever& lever) {
    nlohmann::ordered_json json;
    json["name"] = lever.name;
    json["when"] = lever.when == LeverTime::bake ? "bake" : "render";
    json["what"] = lever.what;
    json["default"] = lever.byDefault;
    if (lever.when == LeverTime::render) json["option"] = lever.option;
    json["settings"] = nlohmann::ordered_json::array();
    for (const LeverSetting& setting : lever.settings)
        json["settings"].push_back({{"name", setting.name}, {"what", setting.what}});
    return json;
}

void print(const Lever& lever) {
    const std::string how =
        lever.when == LeverTime::bake ? "minirtc bake --set " + lever.name + "=" : "minirt-render " + lever.option;
    std::cout << lever.name << ": " << lever.what << " (" << how << ")\n";
    for (const LeverSetting& setting : lever.settings)
        std::cout << "  " << setting.name << (setting.name == lever.byDefault ? " (default)" : "") << ": " << setting.what
                  << "\n";
    if (lever.settings.empty()) std::cout << "  a number; default: " << lever.byDefault << "\n";
}

void print(const Applicability& found) {
    std::cout << (found.applies ? "  matters here: " : "  does not matter here: ") << found.reason << "\n";
}

}  // namespace

SceneFacts factsOf(const std::string& sceneFile, Diagnostics& diagnostics) {
    const Scene scene = loadScene(sceneFile, diagnostics);
    const Geometry geometry = flatten(scene, diagnostics);
    const Volumes volumes = analyseVolumes(scene, geometry, diagnostics, 0);
    return {analyseEffects(scene, geometry, volumes, false, scene.render.tracesPaths()), scene.render.integrators};
}

int listLevers(const LeversOptions& options) {
    Diagnostics diagnostics;
    std::optional<SceneFacts> facts;
    if (!options.scene.empty()) facts = factsOf(options.scene, diagnostics);
    nlohmann::ordered_json json;
    for (const Lever& lever : levers()) {
        nlohmann::ordered_json entry = describe(lever);
        if (!options.json) print(lever);
        if (facts) {
            const Applicability found = applies(lever, facts->effects, facts->integrators);
            entry["applies"] = found.applies;
            entry["reason"] = found.reason;
            if (!options.json) print(found);
        }
        json.push_back(entry);
    }
    if (options.json) std::cout << json.dump(2) << "\n";
    return 0;
}

}  // namespace minirtc
