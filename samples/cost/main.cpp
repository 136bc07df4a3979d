// minirt-cost: what accuracy costs in time on a scene and a device, as a page.
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>

#include "../common/command_line.hpp"
#include "action.hpp"
#include "bake_levers.hpp"
#include "better_picture.hpp"
#include "commands.hpp"
#include "half_time.hpp"
#include "hard_case_levers.hpp"
#include "page.hpp"
#include "recommendation.hpp"
#include "report_json.hpp"
#include "study.hpp"

namespace {

struct Options {
    std::string scene;
    std::string output;
    std::string json;
    std::string device;
    std::string size;
    bool hardCases = false;
    cost::StudyOptions study;
};

void addOptions(CLI::App& app, Options& o) {
    app.footer(
        "Examples:\n  minirt-cost whisky.json -o whisky.html\n  minirt-cost whisky.mrt -o whisky.html --budget-ms 40\n\n"
        "From a scene file (.json) all levers are tried, and the scene is baked for each; from a blob (.mrt), those of the "
        "rendering.");
    app.add_option("scene", o.scene, "Scene file (.json) or blob (.mrt)")->required();
    app.add_option("-o,--output", o.output, "Page to write (.html)")->required();
    app.add_option("--json", o.json, "Write the figures as JSON");
    app.add_option("--size", o.size, "WIDTHxHEIGHT (default: the scene's shape with as many pixels as 256x192)");
    app.add_option("--spp", o.study.samples,
                   "Samples a pixel of the scene's own settings (default: the scene's, or fewer to end in time)")
        ->check(CLI::Range(1u, 4096u));
    app.add_option("--repeats", o.study.repeats, "How often each picture is rendered, in turn with the others (default: 5)")
        ->check(CLI::Range(1u, 1000u));
    app.add_option("--seconds", o.study.seconds,
                   "How long it may take, bakes and pipelines included (default: 300). Each setting is baked and rendered three "
                   "times in any case, in "
                   "pictures of 64x48 where time is short")
        ->check(CLI::PositiveNumber);
    app.add_option("--combinations", o.study.combinations, "Most combinations of levers that are tried (default: 12)")
        ->check(CLI::Range(size_t{0}, size_t{100}));
    app.add_option("--budget-ms", o.study.budgetMs,
                   "Name the settings with the least error whose picture takes no longer than this")
        ->check(CLI::PositiveNumber);
    app.add_flag(
        "--hard-cases", o.hardCases,
        "Also run the scenes in which rounding shows, with each setting of the levers (a minute or two, beyond --seconds)");
    app.add_option("--device", o.device, "Number or part of the name of a device from `minirtc devices`");
}

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::localtime(&now));
    return text;
}

void write(const std::string& path, const std::string& text) {
    const std::string problem = writeWhole(path, {text.begin(), text.end()});
    if (!problem.empty()) throw std::runtime_error(problem);
}

cost::Report run(const Options& options) {
    cost::Report report;
    report.baked = endsWith(options.scene, ".json");
    cost::StudyOptions study = options.study;
    if (!options.size.empty()) parseSize(options.size, study.width, study.height);
    cost::Progress progress;
    Device device(options.device);
    report.device = device.info();
    std::unique_ptr<cost::Baker> baker;
    if (report.baked) baker = std::make_unique<cost::Baker>(options.scene);
    const std::vector<cost::Lever> baked = report.baked ? baker->levers() : std::vector<cost::Lever>();
    const auto blobsOf = [&](const std::vector<cost::Lever>& levers, const std::vector<cost::Configuration>& configurations) {
        return report.baked ? baker->blobsOf(levers, configurations)
                            : std::vector<std::string>(configurations.size(), options.scene);
    };
    cost::Scenes scenes(device, baked, blobsOf);
    const cost::BlobFacts facts = cost::readBlobFacts(blobsOf(baked, {initialConfiguration(baked)}).front());
    cost::study(scenes, facts, report.device.is_cpu != 0, study, progress, report);
    if (options.hardCases) report.hardCases = cost::runHardCases(device, progress);
    return report;
}

/// What a person without the page wants to know.
void print(const cost::Report& report) {
    const auto printAdvice = [&](const std::string& goal, const std::string& advice, const cost::BudgetChoice* choice) {
        std::cout << goal << ": " << advice << "\n";
        if (!choice) return;
        for (const std::string& command : commandsFor(report, *choice)) std::cout << "  " << command << "\n";
    };
    const cost::BudgetChoice advised = recommendedChoice(report);
    printAdvice("The same picture in less time", recommendationSentence(report), &advised);
    const cost::HalfTime half = halfTime(report);
    printAdvice("Half the time", halfTimeSentence(report), half.isShown() ? &*half.choice : nullptr);
    printAdvice("A better picture", betterPictureSentence(report), nullptr);
    for (size_t i : byAction(report)) {
        const cost::Comparison& c = report.comparisons[i];
        if (c.leading) std::cout << instruction(report, c) << ". " << sentence(report.levers[c.lever], c, report.floor()) << "\n";
    }
    if (report.budgetMs > 0) std::cout << budgetSentence(report) << "\n";
}

void study(const Options& options, const std::string& command) {
    if (!endsWith(options.scene, ".json") && !endsWith(options.scene, ".mrt"))
        throw UsageError(options.scene + ": give a scene file (.json) or a blob (.mrt)");
    for (const std::string& path : {options.output, options.json}) {
        const std::string problem = path.empty() ? "" : whyNotWritable(path);
        if (!problem.empty()) throw std::runtime_error(problem);
    }
    cost::Report report = run(options);
    report.scene = std::filesystem::path(options.scene).stem().string();
    report.file = options.scene;
    report.command = command;
    if (!options.device.empty()) report.deviceOption = " --device " + cost::shellWord(options.device);
    report.date = today();
    write(options.output, cost::page(report));
    if (!options.json.empty()) write(options.json, reportJson(report));
    print(report);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("minirt-cost measures what accuracy costs in time on a scene and a device, and writes a page about it",
                 "minirt-cost");
    Options options;
    addOptions(app, options);
    app.failure_message(oneLineFailure);
    CLI11_PARSE(app, argc, argv);
    std::string command = "minirt-cost";
    for (int i = 1; i < argc; ++i) command += " " + cost::shellWord(argv[i]);
    try {
        study(options, command);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
    return 0;
}
