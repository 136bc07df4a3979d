#include <doctest/doctest.h>

#include <algorithm>

#include "command.hpp"
#include "scene.hpp"

#ifdef MINIRT_VIEWER
namespace {

using test::run;
using test::Words;

constexpr const char* kSize = "96x72";
constexpr const char* kSamples = "3";

minirtc::Image readPng(const std::string& path) {
    return minirtc::loadImage(path, minirtc::ColorSpace::linear);
}

/// The share of pixels with a byte that differs by more than 1.
double differingShare(const minirtc::Image& a, const minirtc::Image& b) {
    REQUIRE(a.width == b.width);
    REQUIRE(a.height == b.height);
    size_t count = 0;
    for (size_t i = 0; i < a.texels.size(); ++i) {
        const glm::vec4 difference = glm::abs(a.texels[i] - b.texels[i]) * 255.0f;
        count += std::max({difference.x, difference.y, difference.z}) > 1.5f ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.texels.size());
}

bool haveDisplay() {
    if (run({"xvfb-run", "-a", "true"}).exitCode == 0) return true;
    test::skip("needs xvfb-run and a display that it can start");
    return false;
}

std::string bakeSample(const test::TemporaryDir& dir) {
    const std::string blob = (dir.path() / "minimal.mrt").string();
    REQUIRE(
        run({MINIRTC, "bake", std::string(MINIRT_SOURCE_DIR) + "/samples/scenes/minimal.json", "-o", blob, "--quiet"}).exitCode ==
        0);
    return blob;
}

minirtc::Image screenshot(const std::string& blob, const std::string& path, const Words& more = {}) {
    Words command = {"xvfb-run", "-a", MINIRT_VIEWER, blob, "--size", kSize, "--screenshot", path, "--after-samples", kSamples};
    command.insert(command.end(), more.begin(), more.end());
    const test::Outcome outcome = run(command);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    return readPng(path);
}

}  // namespace

TEST_CASE("the window shows what the renderer writes and changes when the camera moves") {
    if (!test::haveDevice() || !haveDisplay()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const std::string rendered = (dir.path() / "rendered.png").string();
    REQUIRE(run({MINIRT_RENDER, blob, "-o", rendered, "--size", kSize, "--spp", kSamples}).exitCode == 0);
    const minirtc::Image expected = readPng(rendered);

    const minirtc::Image still = screenshot(blob, (dir.path() / "still.png").string());
    CHECK(differingShare(still, expected) <= 0.001);

    const minirtc::Image moved = screenshot(blob, (dir.path() / "moved.png").string(), {"--move", "WD 1"});
    CHECK(differingShare(moved, expected) > 0.1);
}

TEST_CASE("the viewer refuses what it cannot do in one line") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = bakeSample(dir);
    const std::string picture = (dir.path() / "a.png").string();
    const struct {
        Words arguments;
        std::string part;
    } cases[] = {{{blob, "--size", "0x0"}, "--size"},
                 {{blob, "--screenshot", "a.exr"}, ".png"},
                 {{blob, "--screenshot", (dir.path() / "missing" / "a.png").string()}, "folder"},
                 {{blob, "--screenshot", picture, "--after-samples", "0"}, "--after-samples"},
                 {{blob, "--after-samples", "3"}, "--screenshot"},
                 {{blob, "--move", "X 1"}, "WASDEQ"},
                 {{blob, "--device", "no such device"}, "minirtc devices"},
                 {{(dir.path() / "missing.mrt").string()}, "missing.mrt"},
                 {{blob, "--screenshot", picture}, "display"}};
    for (const auto& c : cases) {
        Words command = {MINIRT_VIEWER};
        command.insert(command.end(), c.arguments.begin(), c.arguments.end());
        const test::Outcome outcome = run(command, {"DISPLAY=", "WAYLAND_DISPLAY="});
        CAPTURE(c.part);
        CAPTURE(outcome.err);
        CHECK(outcome.exitCode > 0);
        CHECK(outcome.exitCode < 126);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK(outcome.err.find(c.part) != std::string::npos);
    }
    CHECK_FALSE(std::filesystem::exists(picture));
}
#else
TEST_CASE("the viewer was left out of the build") {
    test::skip("needs minirt-viewer, which needs GLFW and OpenGL");
}
#endif
