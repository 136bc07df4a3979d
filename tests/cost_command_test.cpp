// minirt-cost and budgets of minirt-render as a user runs them, at the size of a stamp.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "command.hpp"

namespace {

using test::Outcome;
using test::run;
using test::Words;
namespace fs = std::filesystem;

std::string sampleScene(const std::string& name) {
    return std::string(MINIRT_SOURCE_DIR) + "/samples/scenes/" + name + ".json";
}

/// A glass ball on a checkered floor: Fresnel and depth matter, dispersion does not.
const char* const kGlassBall = R"({
  "camera": {"position": [0, 1, 4], "target": [0, 0.6, 0], "vfov": 40},
  "background": {"color": [0.4, 0.6, 0.9]},
  "lights": [{"type": "directional", "direction": [-1, -2, -1], "irradiance": [2, 2, 2]}],
  "materials": {
    "glass": {"model": "pbr", "transmission": 1, "roughness": 0, "ior": 1.5},
    "light": {"model": "pbr", "baseColor": [0.8, 0.8, 0.8]}, "dark": {"model": "pbr", "baseColor": [0.2, 0.1, 0.1]},
    "floor": {"model": "checker", "a": "light", "b": "dark", "scale": 0.5}},
  "objects": [{"sphere": {"center": [0, 0.8, 0], "radius": 0.7}, "material": "glass"},
              {"rectangle": {"origin": [-4, 0, -4], "u": [0, 0, 8], "v": [8, 0, 0]}, "material": "floor"}],
  "render": {"integrator": "whitted", "maxDepth": 6, "spp": 16, "size": [32, 24]}
})";

/// What halves the time takes at most half of it.
void checkHalfTime(const nlohmann::json& half) {
    constexpr double kRounding = 1e-6;
    if (half["fits"] == true) CHECK(half["choice"]["ms"] <= half["own"]["ms"].get<double>() / 2 * (1 + kRounding));
}

nlohmann::json measure(const test::TemporaryDir& dir, const std::string& scene, const Words& more = {}) {
    const fs::path page = dir.path() / "report.html";
    const fs::path json = dir.path() / "report.json";
    Words command = {MINIRT_COST, scene,   "-o",        page.string(), "--json",         json.string(),
                     "--size",    "32x24", "--repeats", "3",           "--combinations", "2"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run(command);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exitCode == 0);
    CHECK(outcome.err.empty());
    CHECK(test::readFile(page).size() > 10000);
    nlohmann::json report = nlohmann::json::parse(test::readFile(json));
    checkHalfTime(report["half_time"]);
    return report;
}

/// The measurement in which only this lever differs from the scene's own settings.
nlohmann::json alone(const nlohmann::json& report, const std::string& lever, const std::string& setting) {
    for (const auto& m : report["measurements"])
        if (m["kind"] == "lever" && m["settings"][lever] == setting) return m;
    FAIL("nothing measured of ", lever, " ", setting);
    return {};
}

/// With four times the scene's own samples.
nlohmann::json withMoreSamples(const nlohmann::json& report) {
    return alone(report, "samples", std::to_string(4 * report["scene_samples"].get<int>()));
}

void checkRefused(const Words& command, const std::string& part) {
    const Outcome outcome = run(command);
    CAPTURE(outcome.err);
    CHECK(outcome.exitCode > 0);
    CHECK(outcome.exitCode < 126);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(part) != std::string::npos);
}

/// Whether a browser as wide shows less than all columns of the page's table of all figures: "yes", "no".
std::string isTableCutAt(int width, const test::TemporaryDir& dir) {
    const std::string script =
        "<script>for (const closed of document.querySelectorAll('details')) closed.open = true;"
        "const shown = document.querySelector('.scroll');"
        "document.title = shown.scrollWidth > shown.clientWidth ? 'cut: yes' : 'cut: no';</script>";
    const fs::path page = dir.write("opened.html", test::readFile(dir.path() / "report.html") + script);
    const Outcome outcome = run({"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom",
                                 "--window-size=" + std::to_string(width) + ",2000", page.string()},
                                {"HOME=" + dir.path().string()});
    const std::string title = "<title>cut: ";
    const size_t at = outcome.out.find(title);
    if (at == std::string::npos) return outcome.err;
    const size_t from = at + title.size();
    return outcome.out.substr(from, outcome.out.find('<', from) - from);
}

}  // namespace

TEST_CASE("a scene file's levers are measured against a reference that is more accurate than they are") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const nlohmann::json report = measure(dir, dir.write("ball.json", kGlassBall).string(), {"--seconds", "10", "--spp", "2"});
    CHECK(report["width"] == 32);
    CHECK(report["samples"] == 2);
    CHECK_FALSE(report["device"].get<std::string>().empty());
    const auto& own = report["measurements"][0];
    CHECK(own["repeats"] >= 3);
    CHECK(own["slowdown"]["median"] == 1);
    CHECK(own["kernel_bytes"] > 1000);
    CHECK(own["pipeline_ms"] > 0);
    CHECK(own["ms"]["lower_quartile"] <= own["ms"]["median"]);
    CHECK(report["reference"]["relmse"] > 0);
    CHECK(report["reference"]["relmse"] < own["error"]["relmse"]);
    const auto bare = alone(report, "fresnel", "none");
    CHECK(own["error"]["relmse"] < bare["error"]["relmse"]);
    CHECK(own["same_samples"]["wrong_pixels"] < bare["same_samples"]["wrong_pixels"]);
    CHECK(withMoreSamples(report)["error"]["relmse"] < own["error"]["relmse"]);
    CHECK(alone(report, "depth", "1")["bias"]["relmse"] > own["bias"]["relmse"]);
    CHECK(report["findings"].size() == 2);
    CHECK(report["recommendation"]["commands"].size() == 2);
    CHECK(report["half_time"]["fits"] == true);  // with fewer of 16 samples, however little time one of the two saves
    for (const auto& lever : report["levers"])
        if (lever["name"] == "dispersion") CHECK(lever["applies"] == false);
}

TEST_CASE("a blob's levers are those of the rendering, and its noise is told from its bias") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = (dir.path() / "room.mrt").string();
    REQUIRE(run({MINIRTC, "bake", sampleScene("mis"), "-o", blob, "--quiet"}).exitCode == 0);
    const nlohmann::json report = measure(dir, blob, {"--seconds", "20", "--budget-ms", "5000", "--spp", "2"});
    CHECK(report["baked"] == false);
    CHECK(report["reference"]["random"] == true);
    for (const auto& lever : report["levers"]) CHECK(lever["name"] != "fresnel");
    const auto& own = report["measurements"][0];
    CHECK(own["bias"]["standard_error"] > 0);
    CHECK(withMoreSamples(report)["error"]["relmse"] < own["error"]["relmse"]);
    CHECK(report["budget"]["fits"] == true);
    CHECK(report["budget"]["measured"]["ms"] <= report["budget"]["ms"]);
}

TEST_CASE("a rendering with a budget keeps to it and says what it chose") {
    if (!test::haveDevice()) return;
    const test::TemporaryDir dir;
    const std::string blob = (dir.path() / "ball.mrt").string();
    const fs::path picture = dir.path() / "ball.png";
    REQUIRE(run({MINIRTC, "bake", dir.write("ball.json", kGlassBall).string(), "-o", blob, "--quiet"}).exitCode == 0);
    const Outcome outcome = run({MINIRT_RENDER, blob, "-o", picture.string(), "--budget-ms", "10000"});
    CAPTURE(outcome.err);
    CHECK(outcome.exitCode == 0);
    CHECK(outcome.out.find("Chosen: ") == 0);
    CHECK(outcome.out.find("Nothing is given up.") != std::string::npos);
    CHECK(fs::exists(picture));
    checkRefused({MINIRT_RENDER, blob, "-o", picture.string(), "--budget-ms", "1e-6"}, "fastest settings");
    checkRefused({MINIRT_RENDER, blob, "-o", picture.string(), "--budget-ms", "10", "--spp", "4"}, "--spp");
    checkRefused({MINIRT_RENDER, blob, "-o", picture.string(), "--budget-ms", "0"}, "--budget-ms");
}

TEST_CASE("what cannot be measured is refused in one line before any work") {
    const test::TemporaryDir dir;
    const std::string page = (dir.path() / "a.html").string();
    checkRefused({MINIRT_COST}, "minirt-cost --help");
    checkRefused({MINIRT_COST, "a.json"}, "--output");
    checkRefused({MINIRT_COST, "a.obj", "-o", page}, ".json");
    checkRefused({MINIRT_COST, (dir.path() / "missing.mrt").string(), "-o", page}, "missing.mrt");
    checkRefused({MINIRT_COST, (dir.path() / "missing.json").string(), "-o", page}, "missing.json");
    checkRefused({MINIRT_COST, sampleScene("minimal"), "-o", page, "--repeats", "0"}, "--repeats");
    checkRefused({MINIRT_COST, sampleScene("minimal"), "-o", page, "--size", "0x4"}, "--size");
    checkRefused({MINIRT_COST, sampleScene("minimal"), "-o", (dir.path() / "no" / "a.html").string()}, "folder");
    CHECK(fs::is_empty(dir.path()));
}

TEST_CASE("a browser draws the page without a network") {
    if (!test::haveDevice()) return;
    if (run({"chromium", "--version"}).exitCode != 0) return test::skip("needs chromium");
    const test::TemporaryDir dir;
    const std::string blob = (dir.path() / "minimal.mrt").string();
    REQUIRE(run({MINIRTC, "bake", sampleScene("minimal"), "-o", blob, "--only-default", "--quiet"}).exitCode == 0);
    measure(dir, blob, {"--seconds", "3"});
    const fs::path shot = dir.path() / "page.png";
    const Outcome outcome =
        run({"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND",
             "--window-size=600,2000", "--screenshot=" + shot.string(), (dir.path() / "report.html").string()},
            {"HOME=" + dir.path().string()});
    CAPTURE(outcome.err);
    CHECK(outcome.exitCode == 0);
    REQUIRE(fs::exists(shot));
    CHECK(fs::file_size(shot) > 20000);  // a blank page is a tenth of that
    CHECK(isTableCutAt(1100, dir) == "no");
}
