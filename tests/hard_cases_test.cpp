// Every hard case holds at the default settings, and the settings that the project started from fail where it is known that they do.
#include "hard_cases.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "gpu_context.hpp"

using namespace hard_cases;

namespace {

std::string tableOf(const std::vector<HardCaseResult>& results) {
    std::string table = std::to_string(countHeld(results)) + " of " + std::to_string(results.size()) + " cases held\n";
    char line[256];
    for (const HardCaseResult& result : results) {
        std::snprintf(line, sizeof line, "%-5s%-28s%12.4g of %-8.2g %s%s\n", result.held() ? "held" : "", result.name.c_str(),
                      result.figure, result.bound, result.unit.c_str(), result.failure.c_str());
        table += line;
    }
    return table;
}

}  // namespace

TEST_CASE("the default settings hold every hard case") {
    test::GpuContext gpu(0);
    if (!gpu) return;
    const std::vector<HardCaseResult> results = runHardCases(gpu.get(), {});
    MESSAGE(tableOf(results));
    CHECK(results.size() >= 43);
    for (const HardCaseResult& result : results) {
        CAPTURE(result.name);
        CHECK(result.failure == "");
        CHECK(result.figure <= result.bound);
    }
}

TEST_CASE("the settings of the seed lose the cases that are known of them") {
    test::GpuContext gpu(0);
    if (!gpu) return;
    const std::vector<HardCaseResult> results = runHardCases(gpu.get(), seedSettings());
    MESSAGE(tableOf(results));
    const std::vector<std::string> lost = {"small faces",
                                           "smaller faces",
                                           "tiny and huge",
                                           "vertices",
                                           "edges",
                                           "diagonals",
                                           "needles",
                                           "own shadow far away",
                                           "own shadow farther away",
                                           "second sheet",
                                           "mirror shaft",
                                           "light guide",
                                           "tiny coordinates",
                                           "huge coordinates",
                                           "all scales",
                                           "beside degenerates",
                                           "at degenerates",
                                           "denormals",
                                           "crossings at vertices",
                                           "crossings at edges",
                                           "crossings at diagonals",
                                           "deep nest",
                                           "reflectance from outside",
                                           "reflectance from inside",
                                           "absorption",
                                           "dispersion",
                                           "hidden surfaces"};
    for (const HardCaseResult& result : results) {
        CAPTURE(result.name);
        CHECK(result.failure == "");
        if (std::find(lost.begin(), lost.end(), result.name) != lost.end()) CHECK_FALSE(result.held());
    }
}

TEST_CASE("each cheap lever alone costs what is known of it") {
    test::GpuContext gpu(0);
    if (!gpu) return;
    const auto figure = [&](const minirtc::LeverSettings& levers, const std::string& name) {
        for (const HardCaseResult& result : runHardCases(gpu.get(), levers, name))
            if (result.name == name) return result.figure;
        return -1.0;
    };
    const minirtc::LeverSettings schlick = {{"fresnel", "schlick"}};
    const double outside = figure(schlick, "reflectance from outside");
    CHECK(outside > 0.03);  // 0.036 is the most for an index of 1.5
    CHECK(outside < 0.0365);
    CHECK(figure(schlick, "reflectance from inside") > 0.5);
    CHECK(figure({{"intersection", "moller_trumbore_epsilon"}}, "smaller faces") > 99);
    CHECK(figure({{"intersection", "moller_trumbore"}}, "smaller faces") < 1);  // along a diagonal of the picture
    CHECK(figure({{"intersection", "moller_trumbore"}}, "vertices") > 1);
    CHECK(figure({{"ray_offset", "distance_scaled"}}, "second sheet") > 99);
    CHECK(figure({{"ray_offset", "distance_scaled"}}, "own shadow far away") > 20);
    CHECK(figure({{"ray_offset", "constant"}}, "second sheet") > 99);
    CHECK(figure({{"intersection", "moller_trumbore"}}, "crossings at vertices") > 1);
    CHECK(figure({{"ray_offset", "constant"}}, "tiny coordinates") == 0);  // nothing else is near enough to be passed over
    CHECK(figure({{"ray_offset", "constant"}}, "huge coordinates") > 20);
}

TEST_CASE("doubles hold what floats hold") {
    test::GpuContext gpu(0);
    if (!gpu) return;
    const std::vector<HardCaseResult> results = runHardCases(gpu.get(), {{"precision", "double"}});
    MESSAGE(tableOf(results));
    for (const HardCaseResult& result : results) {
        CAPTURE(result.name);
        CHECK(result.held());
    }
}
