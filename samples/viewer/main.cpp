// minirt-viewer: flies through a blob in a window, the picture refining where the camera rests.
#include <filesystem>
#include <iostream>

#include "../common/command_line.hpp"
#include "viewer.hpp"

namespace {

struct Options {
    std::string blob;
    std::string size;
    std::string device;
    std::string screenshot;
    std::string move;
    uint32_t afterSamples = 16;
};

void addOptions(CLI::App& app, Options& o) {
    app.footer(
        "Keys: W A S D fly, E Q up and down, Shift faster, drag to look, P or F12 save a PNG, Esc quit\n"
        "Examples:\n  minirt-viewer still_life.mrt\n  minirt-viewer still_life.mrt --size 640x480 --screenshot view.png "
        "--after-samples 16");
    app.add_option("blob", o.blob, "Blob that minirtc baked (.mrt)")->required();
    app.add_option("--size", o.size, "WIDTHxHEIGHT of the window (default: the scene's)");
    app.add_option("--device", o.device, "Number or part of the name of a device from `minirtc devices`");
    auto* screenshot = app.add_option("--screenshot", o.screenshot, "Write what the window shows to this PNG and quit");
    app.add_option("--after-samples", o.afterSamples, "Samples a pixel before the screenshot")
        ->needs(screenshot)
        ->check(CLI::Range(1u, 1u << 24))
        ->capture_default_str();
    app.add_option("--move", o.move,
                   "Hold keys at first, such as \"WD 0.5\" for half a second at 60 frames a second (for tests)");
}

ViewerDesc viewerDesc(const Options& o) {
    ViewerDesc desc;
    desc.name = std::filesystem::path(o.blob).stem().string();
    desc.screenshot = o.screenshot;
    if (!o.size.empty()) parseSize(o.size, desc.size.width, desc.size.height);
    if (!o.screenshot.empty()) {
        desc.samples = o.afterSamples;
        if (std::filesystem::path(o.screenshot).extension() != ".png")
            throw UsageError(o.screenshot + ": unknown kind of screenshot; use .png");
        const std::string problem = whyNotWritable(o.screenshot);
        if (!problem.empty()) throw UsageError(problem);
    }
    try {
        if (!o.move.empty()) desc.script = KeyScript(o.move);
    } catch (const std::invalid_argument& error) {
        throw UsageError(std::string("--move: ") + error.what());
    }
    return desc;
}

void view(const Options& options) {
    ViewerDesc desc = viewerDesc(options);
    Device device(options.device);
    minirt_scene* scene = device.load(options.blob);
    if (options.size.empty()) {
        minirt_scene_desc sceneDesc;
        minirt_get_scene_desc(scene, &sceneDesc);
        desc.size = {sceneDesc.width, sceneDesc.height};
    }
    Viewer(desc, device, scene).run();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("minirt-viewer shows a baked scene in a window", "minirt-viewer");
    Options options;
    addOptions(app, options);
    app.failure_message(oneLineFailure);
    CLI11_PARSE(app, argc, argv);
    try {
        view(options);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
    return 0;
}
