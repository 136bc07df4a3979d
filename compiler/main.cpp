// minirtc: bakes scenes into blobs and looks into them.
#include <CLI/CLI.hpp>
#include <iostream>

#include "commands.hpp"

namespace {

using namespace minirtc;

const std::map<std::string, LayoutChoice>& layouts() {
    static const std::map<std::string, LayoutChoice> names = {
        {"auto", LayoutChoice::automatic}, {"quantised", LayoutChoice::quantised}, {"float", LayoutChoice::floating}};
    return names;
}

const std::map<std::string, BvhQuality>& qualities() {
    static const std::map<std::string, BvhQuality> names = {{"fast", BvhQuality::fast}, {"high", BvhQuality::high}};
    return names;
}

std::string oneLineFailure(const CLI::App* app, const CLI::Error& error) {
    for (const CLI::App* subcommand : app->get_subcommands()) app = subcommand;
    const std::string command = app->get_parent() ? app->get_parent()->get_name() + " " + app->get_name() : app->get_name();
    return command + ": " + error.what() + "; see " + command + " --help\n";
}

void addBake(CLI::App& app, BakeOptions& options, std::vector<std::string>& settings) {
    CLI::App* bake = app.add_subcommand("bake", "Bake a scene file into a blob");
    bake->footer(
        "Examples:\n  minirtc bake still_life.json -o still_life.mrt\n  minirtc bake still_life.json -o still_life.mrt "
        "--explain");
    bake->add_option("scene", options.scene, "Scene file (.json)")->required();
    bake->add_option("-o,--output", options.output, "Blob to write (.mrt)")->required();
    bake->add_flag("--explain", options.explain, "Print each effect, in or out of the kernels, and why");
    bake->add_flag("--only-default", options.onlyDefault,
                   "Kernels of the scene's own integrator alone (default: of all that can draw it)");
    bake->add_flag(
        "--share-trees", options.shareTrees,
        "Also a kernel with which a GPU's lanes share the trees of Whitted's tracer: the same picture, sooner where some "
        "trees are long, later where none is");
    bake->add_flag("--all-effects", options.choices.allEffects, "Compile every effect into the kernels, called for or not");
    bake->add_option("--without", options.choices.without, "Leave an effect out that the scene does not call for; repeatable")
        ->allow_extra_args(false);
    bake->add_flag("--force", options.choices.force, "With --without: also where the scene calls for it, for another picture");
    bake->add_option("--set", settings, "LEVER=SETTING of accuracy, see minirtc levers; repeatable")->allow_extra_args(false);
    bake->add_option_function<std::string>(
            "--layout", [&](const std::string& name) { options.layout = layouts().at(name); },
            "Boxes of the hierarchy (default: auto)")
        ->check(CLI::IsMember(layouts()));
    bake->add_option_function<std::string>(
            "--bvh", [&](const std::string& name) { options.bvh = qualities().at(name); },
            "Building of the hierarchy: fast to build, or fast to trace (default: high)")
        ->check(CLI::IsMember(qualities()));
    bake->add_option("--threads", options.threads, "Threads (default: all cores); the blob does not depend on it")
        ->check(CLI::Range(1u, 1024u));
    bake->add_option("--save-glsl", options.saveGlslDir, "Folder for the kernels' GLSL");
    bake->add_option("--stats", options.statsFile, "Write figures as JSON");
    bake->add_flag("--quiet", options.quiet, "Print nothing but warnings and errors");
}

void addLevers(CLI::App& app, LeversOptions& options) {
    CLI::App* levers = app.add_subcommand("levers", "List the accuracy levers, and which of them matter to a scene");
    levers->footer("Examples:\n  minirtc levers\n  minirtc levers still_life.json --json");
    levers->add_option("scene", options.scene, "Scene file (.json)");
    levers->add_flag("--json", options.json, "As JSON");
}

void addInspect(CLI::App& app, InspectOptions& options) {
    CLI::App* inspect = app.add_subcommand("inspect", "Show what a blob holds");
    inspect->footer("Example:\n  minirtc inspect still_life.mrt --json");
    inspect->add_option("blob", options.blob, "Blob (.mrt)")->required();
    inspect->add_flag("--json", options.json, "As JSON");
    inspect->add_flag("--spirv", options.spirv, "Disassemble the kernels");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("minirtc bakes scenes into blobs that minirt.h renders on any Vulkan device", "minirtc");
    app.footer("Example:\n  minirtc bake still_life.json -o still_life.mrt");
    app.failure_message(oneLineFailure);
    app.require_subcommand(1);
    BakeOptions bakeOptions;
    InspectOptions inspectOptions;
    LeversOptions leversOptions;
    std::vector<std::string> settings;
    std::string blob;
    addBake(app, bakeOptions, settings);
    addInspect(app, inspectOptions);
    addLevers(app, leversOptions);
    CLI::App* validate = app.add_subcommand("validate", "Check a blob completely");
    validate->footer("Example:\n  minirtc validate still_life.mrt");
    validate->add_option("blob", blob, "Blob (.mrt)")->required();
    CLI::App* devices = app.add_subcommand("devices", "List the Vulkan devices, best first");
    devices->footer("Example:\n  minirtc devices");
    CLI11_PARSE(app, argc, argv);
    try {
        for (const std::string& setting : settings) readSetting(setting, bakeOptions.choices.levers);
        if (app.got_subcommand("bake")) return bake(bakeOptions);
        if (app.got_subcommand("inspect")) return inspect(inspectOptions);
        if (app.got_subcommand("levers")) return listLevers(leversOptions);
        if (app.got_subcommand(validate)) return validateBlob(blob);
        if (app.got_subcommand(devices)) return listDevices();
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
    return 1;
}
