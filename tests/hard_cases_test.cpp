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
    CHECK(results.size() >= 20);
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
    for (const HardCaseResult& result : results) CHECK(result.failure == "");
}
