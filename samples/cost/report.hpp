// All that a run found, for the page and the JSON.
#pragma once
#include <optional>

#include "budget.hpp"
#include "comparison.hpp"

namespace cost {

/// How many of the hard cases hold with some settings of the levers.
struct HardCases {
    std::string settings;
    size_t held = 0, all = 0;
    std::vector<std::string> broken;  // what was looked at, with figure and bound
};

struct Report {
    std::string scene;         // its file's name
    std::string file;          // as it was named
    std::string command;       // to run it again, as a shell takes it
    std::string deviceOption;  // of minirt-render too: " --device NAME", or "" for the default one
    bool confirmed = false;    // what is recommended was timed once more
    std::string date;
    minirt_device_info device = {};
    uint32_t width = 0, height = 0;
    uint32_t sceneSamples = 0;  // the scene's own; those measured with may be fewer
    bool baked = false;         // from a scene file; else from a blob, of which only render-time levers move
    double seconds = 0;         // that it took, of which
    double prepareSeconds = 0;  // went before the first picture: reading the scene, bakes and pipelines
    size_t pipelines = 0;       // of so many variants of the scene
    std::vector<Lever> levers;
    Reference reference;
    std::vector<Measurement> measurements;  // the scene's own settings, each lever alone, then combinations
    size_t singles = 0;                     // how many of these come before the combinations
    std::vector<size_t> front;              // measurements on the Pareto front
    std::vector<Comparison> comparisons;
    std::vector<Failure> failures;
    double budgetMs = 0;  // 0: none was given
    std::optional<BudgetChoice> choice;
    double choiceMs = 0;         // of the choice, measured
    double choiceRelMse = 0;     // likewise
    uint32_t choiceSamples = 0;  // that were measured of it: fewer than its own where there was no time for all

    std::vector<HardCases> hardCases;  // empty: not asked for

    uint32_t samples() const { return samplesOf(levers, measurements.front().configuration); }
    /// How many times as many samples as were measured the scene takes by itself.
    double moreSamples() const { return static_cast<double>(sceneSamples) / samples(); }
    /// As the scene takes them by itself, for so many that were measured: at least one.
    uint32_t samplesAtScene(double measured) const;
    /// Names the samples as the scene takes them: "64 samples" in place of the 4 that were measured.
    void nameSamples();
    /// The error of a measurement at the scene's own samples, as all sentences, tables and plots give it: what differs from the scene's own settings by
    /// chance alone counts as these.
    double errorOf(size_t measurement) const;
    /// What the reference's own error adds to errorOf(): smaller ones are not to be believed.
    double floor() const { return reference.relMse / moreSamples(); }
    /// Fills `comparisons` from the measurements of single settings.
    void compareSingles();
    /// The comparison that a measurement is of, or null.
    const Comparison* comparisonOf(size_t measurement) const;
    /// The measurement of a configuration that was measured.
    size_t measurementOf(const Configuration& configuration) const;
    /// Whether a configuration has the scene's own settings but for the samples.
    bool isOwnButSamples(const Configuration& configuration) const;
    /// What a measurement is called: its difference from the scene's own settings.
    std::string nameOf(size_t measurement) const;
};

/// "Within 40 ms: ...; gives up ...". Of a report with a budget.
std::string budgetSentence(const Report& report);

}  // namespace cost
