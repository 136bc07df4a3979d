#include "report.hpp"

#include "figures.hpp"

namespace cost {

std::string Report::nameOf(size_t measurement) const {
    const Configuration& own = measurements.front().configuration;
    std::string name;
    for (size_t i = 0; i < levers.size(); ++i) {
        const Configuration& c = measurements[measurement].configuration;
        if (c[i] == own[i]) continue;
        name += (name.empty() ? "" : ", ") + levers[i].settings[c[i]].words;
        if (levers[i].kind == LeverKind::samples && samplesOf(levers, c) == sceneSamples) name += " (the scene's)";
    }
    return name.empty() ? "the scene's own settings" : name;
}

std::string budgetSentence(const Report& report) {
    const std::string limit = number(report.budgetMs) + " ms";
    if (!report.choice)
        return "Nothing fits " + limit + ": the fastest settings take " +
               number(fastestMs(report.levers, report.measurements, 1)) + " ms a sample.";
    std::string text = "Within " + limit + " fit " + choiceWords(report.levers, *report.choice) + ": measured " +
                       number(report.choiceMs) + " ms, error " + number(report.choiceRelMse) +
                       " (the scene's own settings: " + number(report.measurements.front().ms.median) + " ms, " +
                       number(report.measurements.front().error.relMse) + ").";
    return text + " " + givenUpSentence(report.levers, *report.choice);
}

}  // namespace cost
