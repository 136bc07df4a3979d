#include "report_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "action.hpp"
#include "better_picture.hpp"
#include "commands.hpp"
#include "half_time.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

using Json = nlohmann::ordered_json;

Json spreadJson(const Spread& s) {
    return {{"median", s.median}, {"lower_quartile", s.lower}, {"upper_quartile", s.upper}};
}

Json errorsJson(const Errors& e) {
    return {{"relmse", e.relMse}, {"max", e.largest}, {"wrong_pixels", e.wrongPixels}};
}

Json settingsJson(const std::vector<Lever>& levers, const Configuration& configuration) {
    Json json = Json::object();
    for (size_t i = 0; i < levers.size(); ++i) json[levers[i].name] = levers[i].settings[configuration[i]].name;
    return json;
}

Json measurementJson(const Report& report, size_t i) {
    const Measurement& m = report.measurements[i];
    Json json = {{"name", report.nameOf(i)},
                 {"kind", i == 0               ? "own"
                          : i < report.singles ? "lever"
                                               : "combination"},
                 {"settings", settingsJson(report.levers, m.configuration)},
                 {"repeats", m.repeats},
                 {"ms", spreadJson(m.ms)},
                 {"slowdown", spreadJson(m.slowdown)},
                 {"error", errorsJson(m.error)},
                 {"relmse_spread", spreadJson(m.relMse)},
                 {"expected_relmse", report.errorOf(i)},
                 {"bias", {{"relmse", m.bias.value}, {"standard_error", m.bias.standardError}}},
                 {"shift", {{"relmse", m.shift.value}, {"standard_error", m.shift.standardError}}},
                 {"pipeline_ms", m.pipelineMs},
                 {"kernel_bytes", m.kernelBytes},
                 {"on_front", std::find(report.front.begin(), report.front.end(), i) != report.front.end()}};
    if (!report.reference.random) json["same_samples"] = errorsJson(m.sameSamples);
    return json;
}

Json leverJson(const Lever& lever) {
    Json settings = Json::array();
    for (const Setting& setting : lever.settings) settings.push_back(setting.name);
    Json json = {{"name", lever.name},
                 {"settings", settings},
                 {"own", lever.settings[lever.initial].name},
                 {"applies", lever.idle.empty()}};
    if (!lever.idle.empty()) json["reason"] = lever.idle;
    return json;
}

Json comparisonJson(const Report& report, const Comparison& c) {
    const Lever& lever = report.levers[c.lever];
    const char* const changes[] = {"none", "less error", "more error"};
    const Advice advice = adviceOn(report, c);
    return {{"lever", lever.name},
            {"cheap", lever.settings[c.cheap].name},
            {"accurate", lever.settings[c.accurate].name},
            {"leading", c.leading},
            {"scene_has_accurate", c.sceneHasAccurate},
            {"measurement", c.measurement},
            {"slowdown", spreadJson(c.slowdown)},
            {"error_cheap", c.errorCheap},
            {"error_accurate", c.errorAccurate},
            {"change", changes[static_cast<size_t>(c.change)]},
            {"error_removed", c.removed},
            {"wrong_pixels_of_cheap", c.wrongPixels},
            {"usefulness", c.usefulness},
            {"verdict", verdict(c)},
            {"action", actionName(advice.action)},
            {"reason", advice.reason},
            {"sentence", sentence(lever, c, report.floor())}};
}

Json recommendationJson(const Report& report) {
    const size_t choice = recommended(report);
    return {{"sentence", recommendationSentence(report)},
            {"changes", choice != 0},
            {"measurement", choice},
            {"settings", settingsJson(report.levers, report.measurements[choice].configuration)},
            {"commands", commandsFor(report, recommendedChoice(report))}};
}

Json choiceJson(const Report& report, const BudgetChoice& choice) {
    Json settings = settingsJson(report.levers, choice.configuration);
    settings["samples"] = std::to_string(choice.samples);
    return {{"settings", settings}, {"ms", choice.ms}, {"relmse", choice.relMse}, {"commands", commandsFor(report, choice)}};
}

Json halfTimeJson(const Report& report) {
    const HalfTime half = halfTime(report);
    Json json = {{"sentence", halfTimeSentence(report)},
                 {"fits", half.fits},
                 {"measured", half.measurement.has_value()},
                 {"own", choiceJson(report, half.own)}};
    if (half.choice) json["choice"] = choiceJson(report, *half.choice);
    return json;
}

Json budgetJson(const Report& report) {
    Json json = {{"ms", report.budgetMs}, {"fits", report.choice.has_value()}};
    if (!report.choice) return json;
    json["settings"] = settingsJson(report.levers, report.choice->configuration);
    json["settings"]["samples"] = std::to_string(report.choice->samples);
    json["expected"] = {{"ms", report.choice->ms}, {"relmse", report.choice->relMse}};
    json["measured"] = {{"ms", report.choiceMs}, {"relmse", report.choiceRelMse}, {"samples", report.choiceSamples}};
    json["given_up"] = givenUp(report.levers, *report.choice, report.sceneSamples);
    return json;
}

}  // namespace

std::string reportJson(const Report& report) {
    Json json = {{"scene", report.scene},
                 {"command", report.command},
                 {"date", report.date},
                 {"device", report.device.name},
                 {"driver", report.device.driver},
                 {"width", report.width},
                 {"height", report.height},
                 {"samples", report.samples()},
                 {"scene_samples", report.sceneSamples},
                 {"seconds", report.seconds},
                 {"prepare_seconds", report.prepareSeconds},
                 {"baked", report.baked}};
    json["definitions"] = {{"relmse_epsilon", kRelMseEpsilon}, {"wrong_pixel_steps", kUnseenSteps}};
    json["reference"] = {{"settings", settingsJson(report.levers, report.reference.configuration)},
                         {"samples", report.reference.samples},
                         {"random", report.reference.random},
                         {"relmse", report.reference.relMse}};
    json["reference"]["settings"]["samples"] = std::to_string(report.reference.samples);
    json["levers"] = Json::array();
    for (const Lever& lever : report.levers) json["levers"].push_back(leverJson(lever));
    json["measurements"] = Json::array();
    for (size_t i = 0; i < report.measurements.size(); ++i) json["measurements"].push_back(measurementJson(report, i));
    json["comparisons"] = Json::array();
    for (const Comparison& c : report.comparisons) json["comparisons"].push_back(comparisonJson(report, c));
    json["findings"] = Json::array();
    for (size_t i : findings(report)) {
        const Comparison& c = report.comparisons[i];
        json["findings"].push_back(sentence(report.levers[c.lever], c, report.floor()));
    }
    json["recommendation"] = recommendationJson(report);
    json["half_time"] = halfTimeJson(report);
    json["better_picture"] = {{"sentence", betterPictureSentence(report)}, {"sampling_share", samplingShare(report)}};
    json["failures"] = Json::array();
    for (const Failure& f : report.failures)
        json["failures"].push_back({{"settings", settingsJson(report.levers, f.configuration)}, {"reason", f.reason}});
    for (const HardCases& row : report.hardCases)
        json["hard_cases"].push_back({{"settings", row.settings}, {"held", row.held}, {"all", row.all}, {"broken", row.broken}});
    if (report.budgetMs > 0) json["budget"] = budgetJson(report);
    return json.dump(2) + "\n";
}

}  // namespace cost
