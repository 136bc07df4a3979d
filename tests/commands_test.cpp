#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "command.hpp"

#define TINYEXR_USE_THREAD 0
#include <tinyexr.h>

namespace {

using test::Outcome;
using test::run;
using test::Words;
namespace fs = std::filesystem;

const Words kCommands[] = {
    {MINIRTC, "bake"}, {MINIRTC, "inspect"}, {MINIRTC, "validate"}, {MINIRTC, "devices"}, {MINIRTC, "levers"}, {MINIRTC},
    {MINIRT_RENDER},   {MINIRT_COMPARE},     {MINIRT_HELLO},        {MINIRT_BENCH},       {MINIRT_COST},
#ifdef MINIRT_VIEWER
    {MINIRT_VIEWER},
#endif
};

std::string sampleScene() {
    return std::string(MINIRT_SOURCE_DIR) + "/samples/scenes/minimal.json";
}

std::string bakeSample(const test::TemporaryDir& dir) {
    const std::string blob = (dir.path() / "minimal.mrt").string();
    const Outcome baked = run({MINIRTC, "bake", sampleScene(), "-o", blob, "--quiet"});
    REQUIRE(baked.exitCode == 0);
    CHECK(baked.out.empty());
    CHECK(baked.err.empty());
    return blob;
}

Words withArguments(Words command, const Words& arguments) {
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Non-zero exit, silence on stdout, one line on stderr that holds all of `parts`.
void checkRefused(const Words& command, const Words& parts, const Words& environment = {}) {
    const Outcome outcome = run(command, environment);
    CAPTURE(test::shellCommand(command));
    CAPTURE(outcome.err);
    CHECK(outcome.exitCode > 0);
    CHECK(outcome.exitCode < 126);  // neither a signal nor a missing program
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    for (const std::string& part : parts) {
        CAPTURE(part);
        CHECK(contains(outcome.err, part));
    }
}

/// A scene of one mesh; `more` goes to its start, such as "\"background\": {},".
std::string meshScene(const std::string& mesh, const std::string& more = "") {
    return "{" + more +
           R"("camera": {"position": [0, 1, 4], "target": [0, 0, 0]}, "lights": [{"type": "point", "position": [1, 2, 3]}],)" +
           R"("materials": {"m": {"model": "phong"}}, "objects": [{"mesh": ")" + mesh + R"(", "material": "m"}]})";
}

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// The floats of a .pfm, top row first.
std::vector<float> readPfm(const fs::path& path, int& width, int& height) {
    std::istringstream file(test::readFile(path));
    std::string magic;
    std::string scale;
    file >> magic >> width >> height >> scale;
    file.get();
    REQUIRE(magic == "PF");
    REQUIRE(scale == "-1.0");
    const size_t row = static_cast<size_t>(width) * 3;
    std::vector<float> pixels(row * static_cast<size_t>(height));
    for (size_t y = static_cast<size_t>(height); y-- > 0;)
        file.read(reinterpret_cast<char*>(pixels.data() + y * row), static_cast<std::streamsize>(row * 4));
    REQUIRE(file.good());
    return pixels;
}

void checkHasKeys(const nlohmann::json& json, const Words& pointers) {
    for (const std::string& pointer : pointers) {
        CAPTURE(pointer);
        CHECK(json.contains(nlohmann::json::json_pointer(pointer)));
    }
}

}  // namespace

TEST_CASE("every command explains itself with an example") {
    for (const Words& command : kCommands) {
        const Outcome help = run(withArguments(command, {"--help"}));
        CAPTURE(test::shellCommand(command));
        CHECK(help.exitCode == 0);
        CHECK((contains(help.out, "Example") || contains(help.out, "example")));
        CHECK(help.err.empty());
    }
}

TEST_CASE("wrong usage is refused in one line that leads to the help") {
    checkRefused({MINIRTC}, {"subcommand", "--help"});
    checkRefused({MINIRTC, "bkae"}, {"--help"});
    checkRefused({MINIRTC, "bake"}, {"scene", "minirtc bake --help"});
    checkRefused({MINIRTC, "bake", "a.json"}, {"--output", "minirtc bake --help"});
    checkRefused({MINIRTC, "bake", "a.json", "-o", "a.mrt", "--layout", "best"}, {"--layout", "best", "quantised"});
    checkRefused({MINIRTC, "bake", "a.json", "-o", "a.mrt", "--layout", "1"}, {"--layout"});
    checkRefused({MINIRTC, "bake", "a.json", "-o", "a.mrt", "--threads", "0"}, {"--threads"});
    checkRefused({MINIRTC, "bake", "a.json", "-o", "a.mrt", "--threads", "999999"}, {"--threads"});
    checkRefused({MINIRTC, "bake", "a.json", "-o", "a.mrt", "--bvh", "best"}, {"--bvh", "fast", "high"});
    checkRefused({MINIRT_BENCH, "--rounds", "0"}, {"--rounds"});
    checkRefused({MINIRTC, "inspect"}, {"blob", "minirtc inspect --help"});
    checkRefused({MINIRTC, "devices", "more"}, {"more"});
    checkRefused({MINIRT_RENDER}, {"blob", "minirt-render --help"});
    checkRefused({MINIRT_RENDER, "a.mrt"}, {"--output", "minirt-render --help"});
    checkRefused({MINIRT_RENDER, "a.mrt", "-o", "a.png", "--colour"}, {"--colour", "minirt-render --help"});
    checkRefused({MINIRT_HELLO}, {"usage"});
}

TEST_CASE("levers and effects are chosen by name, and the nearest name is told") {
    const test::TemporaryDir dir;
    const std::string blob = (dir.path() / "a.mrt").string();
    const auto bake = [&](const Words& options) {
        return withArguments({MINIRTC, "bake", sampleScene(), "-o", blob, "--only-default"}, options);
    };
    checkRefused(bake({"--set", "fresnl=none"}), {"'fresnl'", "did you mean 'fresnel'?"});
    checkRefused(bake({"--set", "fresnel=shlick"}), {"'shlick'", "did you mean 'schlick'?"});
    checkRefused(bake({"--set", "fresnel"}), {"LEVER=SETTING", "minirtc levers"});
    checkRefused(bake({"--set", "depth=3"}), {"--max-depth"});
    checkRefused(bake({"--without", "sphere"}), {"'sphere'", "did you mean 'spheres'?"});
    checkRefused(bake({"--without", "point_lights"}), {"'point_lights'", "light 0", "--force"});
    CHECK_FALSE(fs::exists(blob));
    CHECK(run(bake({"--without", "lens", "--without", "textures"})).exitCode == 0);
    const Outcome forced = run(bake({"--without", "point_lights", "--force", "--set", "fresnel=none", "--set", "fresnel=schlick",
                                     "--set", "normals=flat", "--explain"}));
    CHECK(forced.exitCode == 0);
    CHECK(contains(forced.out, "out  point_lights: left out by --without"));
    CHECK(contains(forced.out, "set  fresnel: schlick, by default exact"));
    CHECK(contains(forced.out, "set  normals: flat, by default smooth"));
    CHECK_FALSE(contains(forced.out, "set  intersection"));
    CHECK(contains(run({MINIRTC, "inspect", blob}).out, "set  fresnel: schlick\n"));
    const nlohmann::json inspected = nlohmann::json::parse(run({MINIRTC, "inspect", blob, "--json"}).out);
    CHECK(inspected["levers"] == nlohmann::json{{"fresnel", "schlick"}, {"normals", "flat"}});
}

TEST_CASE("the list of levers says which of them matter to a scene") {
    const Outcome list = run({MINIRTC, "levers"});
    CHECK(list.exitCode == 0);
    CHECK(contains(list.out, "watertight (default)"));
    CHECK_FALSE(contains(list.out, "matters here"));
    const nlohmann::json levers = nlohmann::json::parse(run({MINIRTC, "levers", sampleScene(), "--json"}).out);
    REQUIRE(levers.size() == 13);
    for (const nlohmann::json& lever : levers) {
        checkHasKeys(lever, {"/name", "/when", "/what", "/default", "/settings", "/applies", "/reason"});
        if (lever["name"] == "fresnel") CHECK(lever["applies"] == false);
        if (lever["name"] == "intersection") CHECK(lever["applies"] == true);
    }
    checkRefused({MINIRTC, "levers", "absent.json"}, {"absent.json"});
}

TEST_CASE("options out of range are refused before any work and leave no file") {
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const test::TemporaryDir outputs;
    const std::string picture = (outputs.path() / "a.png").string();
    const struct {
        const char* option;
        const char* value;
        const char* advice;
    } cases[] = {{"--size", "0x0", "640x480"},
                 {"--size", "64", "640x480"},
                 {"--size", "64x48x3", "640x480"},
                 {"--size", "64x99999", "640x480"},
                 {"--size", "-4x4", "640x480"},
                 {"--samples", "3:1", "A < B"},
                 {"--samples", "2:2", "A < B"},
                 {"--samples", "4", "A < B"},
                 {"--region", "0,0", "X,Y,WIDTHxHEIGHT"},
                 {"--spp", "0", "1 to"},
                 {"--spp", "many", "--spp"},
                 {"--max-depth", "256", "255"},
                 {"--cutoff", "-1", "--cutoff"},
                 {"--cutoff", "2", "--cutoff"},
                 {"--integrator", "fast", "whitted"},
                 {"--integrator", "1", "whitted"},
                 {"--light-sampling", "best", "surfaces"},
                 {"--light-sampling", "1", "surfaces"},
                 {"--seed", "-1", "--seed"},
                 {"--seed", "4294967296", "--seed"},
                 {"--clamp", "0", "--clamp"},
                 {"--clamp", "-2", "--clamp"},
                 {"--time-budget", "-1", "--time-budget"}};
    for (const auto& c : cases) checkRefused({MINIRT_RENDER, blob, "-o", picture, c.option, c.value}, {c.option, c.advice});
    CHECK(fs::is_empty(outputs.path()));
}

TEST_CASE("a region outside of the picture is refused") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const std::string picture = (dir.path() / "a.png").string();
    checkRefused({MINIRT_RENDER, blob, "-o", picture, "--size", "8x8", "--region", "4,4,8x8"}, {"region", "outside"});
    CHECK_FALSE(fs::exists(picture));
}

TEST_CASE("a file that is no blob is named by every command that reads one") {
    const test::TemporaryDir dir;
    const std::string whole = test::readFile(bakeSample(dir));
    std::string damaged = whole;
    damaged[whole.size() / 2] ^= 4;
    const std::string names[] = {dir.write("text.mrt", "a line of text").string(),
                                 dir.write("empty.mrt", "").string(),
                                 dir.write("header.mrt", whole.substr(0, 40)).string(),
                                 dir.write("half.mrt", whole.substr(0, whole.size() / 2)).string(),
                                 dir.write("damaged.mrt", damaged).string(),
                                 (dir.path() / "missing.mrt").string()};
    const test::TemporaryDir outputs;
    for (const std::string& name : names) {
        checkRefused({MINIRTC, "inspect", name}, {name, ";"});
        checkRefused({MINIRTC, "validate", name}, {name, ";"});
    }
    if (!test::haveDevice()) return;
    for (const std::string& name : names) {
        checkRefused({MINIRT_RENDER, name, "-o", (outputs.path() / "a.png").string()}, {name, ";"});
        checkRefused({MINIRT_HELLO, name}, {name});
    }
    CHECK(fs::is_empty(outputs.path()));
}

TEST_CASE("an output that cannot be written is refused and leaves nothing") {
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const test::TemporaryDir outputs;
    const std::string noFolder = (outputs.path() / "missing" / "a").string();
    fs::create_directory(outputs.path() / "folder.png");
    const std::string folder = (outputs.path() / "folder.png").string();
    const std::string fine = (outputs.path() / "fine.png").string();
    checkRefused({MINIRT_RENDER, blob, "-o", noFolder + ".png"}, {noFolder, "folder"});
    checkRefused({MINIRT_RENDER, blob, "-o", folder}, {folder, "folder"});
    checkRefused({MINIRT_RENDER, blob, "-o", fine, "--stats", noFolder + ".json"}, {noFolder, "folder"});
    for (const char* name : {"a.gif", "a", "a.PNG.txt", ".png"})
        checkRefused({MINIRT_RENDER, blob, "-o", (outputs.path() / name).string()}, {name, ".png, .exr, .hdr or .pfm"});
    checkRefused({MINIRTC, "bake", sampleScene(), "-o", noFolder + ".mrt"}, {noFolder, "folder"});
    checkRefused({MINIRTC, "bake", sampleScene(), "-o", folder}, {folder, "folder"});
    checkRefused({MINIRTC, "bake", sampleScene(), "-o", fine, "--stats", noFolder + ".json"}, {noFolder, "folder"});
    CHECK(fs::is_empty(folder));
    CHECK(std::distance(fs::directory_iterator(outputs.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("a scene that cannot be baked is refused by the name of the file at fault") {
    const test::TemporaryDir dir;
    dir.write("triangle.obj", kTriangle);
    dir.write("garbage.obj", std::string("\x7f\x45\x4c\x46\0\1\2\3", 8));
    dir.write("empty.obj", "# no faces\nv 0 0 0\n");
    dir.write("flat.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    dir.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    dir.write("text.png", "no image");
    const struct {
        const char* scene;
        std::string text;
        Words parts;
    } cases[] = {{"garbage.json", meshScene("garbage.obj"), {"garbage.obj"}},
                 {"empty.json", meshScene("empty.obj"), {"empty.obj", "faces"}},
                 {"flat.json", meshScene("flat.obj"), {"flat.json", "area"}},
                 {"nan.json", meshScene("nan.obj"), {"nan.obj:2", "nan", "finite"}},
                 {"nomesh.json", meshScene("missing.obj"), {"nomesh.json:1:", "missing.obj"}},
                 {"image.json", meshScene("triangle.obj", R"("background": {"image": "text.png"},)"), {"text.png", "image"}},
                 {"noimage.json",
                  meshScene("triangle.obj", R"("background": {"image": "missing.png"},)"),
                  {"noimage.json:1:", "missing.png"}},
                 {"unknown.json", meshScene("triangle.obj", R"("ligths": [],)"), {"unknown.json:1:", "ligths", "lights"}},
                 {"broken.json", "{\"camera\":", {"broken.json:1:"}},
                 {"huge.json",
                  R"({"materials": {"m": {"model": "phong", "diffuse": 1e30, "color": [1e30, 1, 1]}},)"
                  R"("objects": [{"sphere": {"center": [0, 0, 0], "radius": 1}, "material": "m"}]})",
                  {"huge.json", "material 0", "too large"}},
                 {"nothing.json", R"({"objects": []})", {"nothing.json:1:"}}};
    const test::TemporaryDir outputs;
    const std::string blob = (outputs.path() / "a.mrt").string();
    for (const auto& c : cases)
        checkRefused({MINIRTC, "bake", dir.write(c.scene, c.text).string(), "-o", blob}, withArguments(c.parts, {";"}));
    const std::string missing = (dir.path() / "missing.json").string();
    checkRefused({MINIRTC, "bake", missing, "-o", blob}, {missing, "exists"});
    CHECK(fs::is_empty(outputs.path()));
    const std::string scene = dir.write("good.json", meshScene("triangle.obj")).string();
    checkRefused({MINIRTC, "bake", scene, "-o", scene}, {scene, "scene itself"});
    CHECK(test::readFile(scene) == meshScene("triangle.obj"));
}

TEST_CASE("an unknown device is refused with the way to list them") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const std::string picture = (dir.path() / "a.png").string();
    for (const char* device : {"no such device", "99"})
        checkRefused({MINIRT_RENDER, blob, "-o", picture, "--device", device}, {device, "minirtc devices"});
    CHECK_FALSE(fs::exists(picture));
}

TEST_CASE("without any Vulkan driver the commands that need one say what to install") {
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const std::string picture = (dir.path() / "a.png").string();
    const Words noDriver = {"VK_DRIVER_FILES=/nonexistent", "VK_ICD_FILENAMES=/nonexistent"};
    for (const Words& command :
         {Words{MINIRT_RENDER, blob, "-o", picture}, Words{MINIRT_HELLO, blob}, Words{MINIRTC, "devices"}}) {
        checkRefused(command, {"Vulkan", "mesa-vulkan-drivers"}, noDriver);
        CHECK(run(command, noDriver).exitCode == 1);
    }
    CHECK_FALSE(fs::exists(picture));
    CHECK(run({MINIRTC, "validate", blob}, noDriver).exitCode == 0);
}

TEST_CASE("the blob does not depend on the number of threads") {
    const test::TemporaryDir dir;
    std::string mesh;
    for (int i = 0; i < 3000; ++i) {
        const std::string x = std::to_string(i % 60);
        const std::string y = std::to_string(i / 60);
        mesh += "v " + x + " " + y + " 0\nv " + x + ".7 " + y + " 0.2\nv " + x + " " + y + ".6 0.1\nf -3 -2 -1\n";
    }
    dir.write("many.obj", mesh);
    const std::string scene = dir.write("many.json", meshScene("many.obj")).string();
    for (const char* threads : {"1", "2"}) {
        const Outcome baked =
            run({MINIRTC, "bake", scene, "-o", (dir.path() / threads).string(), "--threads", threads, "--quiet"});
        CHECK(baked.exitCode == 0);
        CHECK(baked.out.empty());
        CHECK(baked.err.empty());
    }
    CHECK(test::readFile(dir.path() / "1") == test::readFile(dir.path() / "2"));
}

TEST_CASE("a bake explains its effects and writes figures and shader sources") {
    const test::TemporaryDir dir;
    const std::string stats = (dir.path() / "stats.json").string();
    const Outcome baked = run({MINIRTC, "bake", sampleScene(), "-o", (dir.path() / "a.mrt").string(), "--explain", "--stats",
                               stats, "--save-glsl", (dir.path() / "glsl").string()});
    CHECK(baked.exitCode == 0);
    CHECK(contains(baked.out, "in   "));
    CHECK(contains(baked.out, "out  "));
    CHECK(baked.err.empty());
    CHECK(contains(test::readFile(dir.path() / "glsl" / "whitted.comp"), "void main"));
    const auto json = nlohmann::json::parse(test::readFile(stats));
    checkHasKeys(json, {"/triangles", "/bvh/nodes", "/bvh/leaves", "/bvh/max_depth", "/bvh/sah_cost", "/bvh/build_ms", "/effects",
                        "/spirv_bytes", "/blob_bytes", "/total_ms"});
    for (const auto& effect : json["effects"]) checkHasKeys(effect, {"/included", "/reason"});
    CHECK(json["blob_bytes"] == fs::file_size(dir.path() / "a.mrt"));
}

TEST_CASE("inspect shows a blob as text and as JSON and as SPIR-V") {
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const Outcome text = run({MINIRTC, "inspect", blob});
    CHECK(text.exitCode == 0);
    CHECK(contains(text.out, "primitives"));
    const Outcome json = run({MINIRTC, "inspect", blob, "--json"});
    CHECK(json.exitCode == 0);
    const auto parsed = nlohmann::json::parse(json.out);
    checkHasKeys(parsed, {"/counts/primitives", "/defaults/width", "/bvh", "/effects", "/kernels/0/name"});
    CHECK(parsed["bytes"] == fs::file_size(blob));
    const Outcome spirv = run({MINIRTC, "inspect", blob, "--spirv"});
    CHECK(spirv.exitCode == 0);
    CHECK(contains(spirv.out, "OpEntryPoint GLCompute"));
    const Outcome valid = run({MINIRTC, "validate", blob});
    CHECK(valid.exitCode == 0);
    CHECK(contains(valid.out, "valid"));
}

TEST_CASE("devices lists what there is from number 0 on") {
    if (!test::haveDevice()) return;
    const Outcome devices = run({MINIRTC, "devices"});
    CHECK(devices.out.rfind("0  ", 0) == 0);
    CHECK(devices.err.empty());
}

TEST_CASE("a rendering is silent and repeats bit for bit with figures") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const std::string stats = (dir.path() / "stats.json").string();
    for (const char* name : {"first.pfm", "second.pfm"}) {
        const Outcome rendered =
            run({MINIRT_RENDER, blob, "-o", (dir.path() / name).string(), "--size", "40x30", "--spp", "3", "--stats", stats});
        CHECK(rendered.exitCode == 0);
        CHECK(rendered.out.empty());
        CHECK(rendered.err.empty());
    }
    CHECK(test::readFile(dir.path() / "first.pfm") == test::readFile(dir.path() / "second.pfm"));
    const auto json = nlohmann::json::parse(test::readFile(stats));
    checkHasKeys(json, {"/device", "/width", "/height", "/spp", "/wall_ms", "/gpu_ms", "/pipeline_ms", "/load_ms", "/upload_ms",
                        "/rays/primary", "/rays/shadow", "/rays/secondary", "/mrays_per_s", "/counters/nan_pixels",
                        "/counters/volume_overflow", "/counters/segment_overflow", "/counters/traversal_cap"});
    CHECK(json["width"] == 40);
    CHECK(json["height"] == 30);
    CHECK(json["spp"] == 3);
    CHECK(json["rays"]["primary"] == 40 * 30 * 3);
    CHECK(json["counters"]["nan_pixels"] == 0);
}

TEST_CASE("pfm and exr hold the same floats") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    for (const char* name : {"a.pfm", "a.exr"})
        REQUIRE(run({MINIRT_RENDER, blob, "-o", (dir.path() / name).string(), "--size", "37x23", "--spp", "2"}).exitCode == 0);
    int width = 0;
    int height = 0;
    const std::vector<float> pfm = readPfm(dir.path() / "a.pfm", width, height);
    CHECK(width == 37);
    CHECK(height == 23);
    float* exr = nullptr;
    const char* message = nullptr;
    REQUIRE(LoadEXR(&exr, &width, &height, (dir.path() / "a.exr").c_str(), &message) == TINYEXR_SUCCESS);
    CHECK(width == 37);
    CHECK(height == 23);
    size_t different = 0;
    for (size_t pixel = 0; pixel < pfm.size() / 3; ++pixel)
        different += std::memcmp(&pfm[3 * pixel], exr + 4 * pixel, 3 * sizeof(float)) != 0 ? 1 : 0;
    CHECK(different == 0);
    free(exr);
}

TEST_CASE("parts of the samples and of the picture are those of the whole") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const auto render = [&](const char* name, const Words& more) {
        const std::string path = (dir.path() / name).string();
        REQUIRE(run(withArguments({MINIRT_RENDER, blob, "-o", path, "--size", "32x24"}, more)).exitCode == 0);
        int width = 0;
        int height = 0;
        return readPfm(path, width, height);
    };
    const std::vector<float> first = render("first.pfm", {"--samples", "0:1"});
    const std::vector<float> second = render("second.pfm", {"--samples", "1:2"});
    const std::vector<float> both = render("both.pfm", {"--spp", "2"});
    const std::vector<float> region = render("region.pfm", {"--samples", "0:1", "--region", "5,6,20x10"});
    for (size_t i = 0; i < both.size(); ++i) {
        CHECK(both[i] == (first[i] + second[i]) / 2);
        const size_t x = i / 3 % 32;
        const size_t y = i / 3 / 32;
        const bool inside = x >= 5 && x < 25 && y >= 6 && y < 16;
        CHECK(region[i] == (inside ? first[i] : 0.0f));
    }
}

TEST_CASE("options of the path tracers reach them") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string scene =
        R"({"camera":{"position":[0,2,5],"target":[0,0,0]},"render":{"integrator":"path","spp":4,"size":[16,12]},
        "lights":[{"type":"rectangle","origin":[-1,2,-1],"u":[2,0,0],"v":[0,0,2],"radiance":[3,2,1]}],"materials":{"m":{"model":"pbr"}},
        "objects":[{"rectangle":{"origin":[-4,0,4],"u":[8,0,0],"v":[0,0,-8]},"material":"m"}]})";
    const std::string blob = (dir.path() / "lamp.mrt").string();
    REQUIRE(run({MINIRTC, "bake", dir.write("lamp.json", scene).string(), "-o", blob, "--quiet"}).exitCode == 0);
    const auto render = [&](const Words& more) {
        const std::string path = (dir.path() / "lamp.pfm").string();
        REQUIRE(run(withArguments({MINIRT_RENDER, blob, "-o", path}, more)).exitCode == 0);
        int width = 0;
        int height = 0;
        return readPfm(path, width, height);
    };
    const std::vector<float> plain = render({});
    CHECK(render({"--seed", "0", "--light-sampling", "mis"}) == plain);
    CHECK(render({"--seed", "1"}) != plain);
    const std::vector<float> balance = render({"--light-sampling", "balance"});
    const std::vector<float> lights = render({"--light-sampling", "lights"});
    const std::vector<float> surfaces = render({"--light-sampling", "surfaces"});
    CHECK(std::set<std::vector<float>>{plain, balance, lights, surfaces}.size() == 4);
    CHECK(render({"--clamp", "1000"}) == plain);
    const std::vector<float> clamped = render({"--clamp", "0.25"});
    CHECK(clamped != plain);
    for (size_t i = 0; i < plain.size(); ++i) CHECK(clamped[i] <= std::min(plain[i], 0.25f));
}

TEST_CASE("hello prints the three numbers of a colour") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const Outcome hello = run({MINIRT_HELLO, bakeSample(dir)});
    CHECK(hello.exitCode == 0);
    CHECK(hello.err.empty());
    std::istringstream numbers(hello.out);
    float red = -1;
    float green = -1;
    float blue = -1;
    std::string more;
    CHECK((numbers >> red >> green >> blue));
    CHECK_FALSE((numbers >> more));
    CHECK(std::min({red, green, blue}) > 0);
    CHECK(red > blue);  // clay
}

TEST_CASE("compare measures the difference of two pictures and judges it") {
    const test::TemporaryDir dir;
    const auto picture = [&](const std::string& name, const std::string& size, const std::vector<float>& floats) {
        const std::string bytes(reinterpret_cast<const char*>(floats.data()), floats.size() * sizeof(float));
        return dir.write(name, "PF\n" + size + "\n-1.0\n" + bytes).string();
    };
    const std::string black = picture("black.pfm", "2 1", {0, 0, 0, 0, 0, 0});
    const std::string spot = picture("spot.pfm", "2 1", {0, 0, 0, 0, 0.5f, 0});
    const Outcome same = run({MINIRT_COMPARE, black, black, "--max-rmse", "0"});
    CHECK(same.exitCode == 0);
    CHECK(contains(same.out, "rmse 0  largest 0  pixels over 0.001: 0 of 2"));
    const Outcome different = run({MINIRT_COMPARE, black, spot});
    CHECK(different.exitCode == 0);
    CHECK(contains(different.out, "rmse 0.204124  largest 0.5  pixels over 0.001: 1 of 2"));  // sqrt(0.25 / 6)
    CHECK(run({MINIRT_COMPARE, black, spot, "--max-rmse", "0.2"}).exitCode == 1);
    checkRefused({MINIRT_COMPARE, black, picture("tall.pfm", "1 2", {0, 0, 0, 0, 0, 0})}, {"tall.pfm", "same size"});
    checkRefused({MINIRT_COMPARE, black, picture("short.pfm", "2 1", {0, 0, 0})}, {"short.pfm", "last pixel"});
    checkRefused({MINIRT_COMPARE, black, dir.write("text.pfm", "hello").string()}, {"text.pfm", ".pfm"});
    checkRefused({MINIRT_COMPARE, black, (dir.path() / "none.pfm").string()}, {"none.pfm", "exist"});
}

TEST_CASE("minirt-bench writes what it measured") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string file = (dir.path() / "bench.json").string();
    const Outcome outcome = run({MINIRT_BENCH, "--knots", "500,1500", "--size", "64x64", "--rounds", "1", "--profile", "--frames",
                                 sampleScene(), "--spp", "1", "--json", file});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    const auto json = nlohmann::json::parse(test::readFile(file));
    const auto& mesh = json["meshes"][0];
    CHECK(mesh["triangles"].get<int>() > 400);
    CHECK(mesh["bytes_per_triangle"]["blob"].get<double>() < 100);
    for (const char* rays : {"primary", "shadow", "diffuse", "shuffled"}) {
        CHECK(mesh["rays"][rays]["tracers"]["minirt"]["mrays_per_s"]["median"].get<double>() > 0);
        const auto& profile = mesh["rays"][rays]["profile"];
        CHECK(profile["node_steps"]["mean"].get<double>() >= 1);
        CHECK(profile["node_steps_per_s"].get<double>() > 0);
        CHECK(profile["differing"] == 0);
    }
    CHECK(mesh["hierarchies"]["minirt high"]["sah_cost"].get<double>() > 1);
    CHECK(json["scenes"][0]["frames"]["whitted"]["ms_per_sample"]["median"].get<double>() > 0);
    if (mesh["rays"]["primary"]["tracers"].contains("Embree robust")) {
        REQUIRE(json["scaling"].size() == 4);
        CHECK(json["scaling"][0]["to_triangles"].get<int>() > 1200);
    }
    const auto& scene = json["scenes"][0];
    for (const char* start : {"cold", "second"}) {
        const double pipeline = scene["start"][start]["pipeline_ms"]["median"].get<double>();
        CHECK(pipeline > 0);
        CHECK(scene["start"][start]["process_ms"]["median"].get<double>() > pipeline);
    }
    CHECK(scene["load"]["bytes"] == scene["blob_bytes"]);
    CHECK(scene["load"]["copy_over_load"]["median"].get<double>() > 0);
}
