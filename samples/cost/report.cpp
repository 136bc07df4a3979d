#include "report.hpp"

#include <algorithm>
#include <cmath>

#include "figures.hpp"

namespace cost {

std::string Report::nameOf(size_t measurement) const {
    const Configuration& own = measurements.front().configuration;
    std::string name;
    for (size_t i = 0; i < levers.size(); ++i) {
        const Configuration& c = measurements[measurement].configuration;
        if (c[i] == own[i]) continue;
        name += (name.empty() ? "" : ", ") + levers[i].settings[c[i]].words;
    }
    return name.empty() ? "the scene's own settings" : name;
}

uint32_t Report::samplesAtScene(double measured) const {
    return static_cast<uint32_t>(std::max(std::lround(measured * moreSamples()), 1L));
}

void Report::nameSamples() {
    for (Setting& setting : levers[findLever(levers, LeverKind::samples)].settings) {
        const uint32_t samples = samplesAtScene(setting.value);
        setting.name = std::to_string(samples);
        setting.words = setting.name + (samples == 1 ? " sample" : " samples");
    }
}

void Report::compareSingles() {
    comparisons =
        compareLevers(levers, {measurements.begin(), measurements.begin() + static_cast<ptrdiff_t>(singles)}, moreSamples());
}

const Comparison* Report::comparisonOf(size_t measurement) const {
    const auto found =
        std::find_if(comparisons.begin(), comparisons.end(), [&](const Comparison& c) { return c.measurement == measurement; });
    return found == comparisons.end() ? nullptr : &*found;
}

size_t Report::measurementOf(const Configuration& configuration) const {
    const auto found = std::find_if(measurements.begin(), measurements.end(),
                                    [&](const Measurement& m) { return m.configuration == configuration; });
    return static_cast<size_t>(found - measurements.begin());
}

bool Report::isOwnButSamples(const Configuration& configuration) const {
    const size_t samples = findLever(levers, LeverKind::samples);
    const Configuration& own = measurements.front().configuration;
    return with(configuration, samples, own[samples]) == own;
}

double Report::errorOf(size_t measurement) const {
    const Comparison* compared = comparisonOf(measurement);
    return compared ? compared->errorThen() : expectedError(levers, measurements, measurements[measurement], moreSamples());
}

std::string budgetSentence(const Report& report) {
    const std::string limit = number(report.budgetMs) + " ms";
    if (!report.choice)
        return "Nothing fits " + limit + ": the fastest settings take " +
               number(fastestMs(report.levers, report.measurements, 1)) + " ms a sample.";
    std::string text = "Within " + limit + " fit " + choiceWords(report.levers, *report.choice) +
                       (report.choiceSamples < report.choice->samples ? ": about " : ": measured ") + number(report.choiceMs) +
                       " ms, error " + errorFigure(report.choiceRelMse, report.floor()) +
                       " (the scene's own settings: " + number(report.measurements.front().ms.median * report.moreSamples()) +
                       " ms, " + errorFigure(report.errorOf(0), report.floor()) + ").";
    return text + " " + givenUpSentence(report.levers, *report.choice, report.sceneSamples);
}

}  // namespace cost
