// minirt-samples: writes the sample scenes and all they refer to.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "generate.hpp"

int main(int argc, char** argv) {
    CLI::App app(
        "Writes the sample scenes, their meshes, textures and panorama into a folder.\n\n"
        "Example:\n  minirt-samples scenes && minirtc bake scenes/still_life.json -o still_life.mrt\n");
    std::filesystem::path folder;
    app.add_option("OUTDIR", folder, "Folder to write to; created if need be")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        samples::generate(folder);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
