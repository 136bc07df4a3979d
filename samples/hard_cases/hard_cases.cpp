#include "hard_cases.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

#include "cases.hpp"

namespace hard_cases {
namespace {

std::vector<HardCase> allCases() {
    std::vector<HardCase> all;
    for (const auto& part : {intersectionCases(), originCases(), opticsCases(), mediaCases(), crossingCases()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

HardCaseResult run(const HardCase& one, const minirtc::LeverSettings& levers, Stage& stage) {
    HardCaseResult result{one.name, one.what, one.unit, 0, one.bound, ""};
    stage.set(levers);
    try {
        result.figure = one.figure(stage);
    } catch (const std::exception& error) {
        result.failure = error.what();
    }
    return result;
}

}  // namespace

std::vector<HardCaseResult> runHardCases(minirt_context* context, const minirtc::LeverSettings& levers, const std::string& only) {
    minirtc::KernelCompiler compiler(1);
    Stage stage(context, compiler);
    std::vector<HardCaseResult> results;
    for (const HardCase& one : allCases())
        if (one.name.find(only) != std::string::npos) results.push_back(run(one, levers, stage));
    return results;
}

std::vector<std::vector<HardCaseResult>> runHardCases(const std::vector<minirt_context*>& contexts,
                                                      const std::vector<minirtc::LeverSettings>& settings,
                                                      const CaseProgress& progress) {
    const std::vector<HardCase> cases = allCases();
    std::vector<std::vector<HardCaseResult>> results(settings.size(), std::vector<HardCaseResult>(cases.size()));
    minirtc::KernelCompiler compiler(1);
    std::mutex mutex;
    size_t next = 0;
    size_t done = 0;
    // Each thread begins with settings of its own: neighbouring cases have like kernels, and in step with each other one thread would wait for what the other
    // compiles.
    const auto work = [&](size_t thread) {
        Stage stage(contexts[thread], compiler);
        const size_t first = thread * settings.size() / contexts.size();
        std::unique_lock<std::mutex> lock(mutex);
        while (next < cases.size()) {
            const size_t i = next++;
            lock.unlock();
            for (size_t k = 0; k < settings.size(); ++k) {
                const size_t s = (first + k) % settings.size();
                results[s][i] = run(cases[i], settings[s], stage);
            }
            stage.clear();
            lock.lock();
            progress(++done, cases.size());
        }
    };
    std::vector<std::thread> threads;
    threads.reserve(contexts.size());
    for (size_t thread = 0; thread < contexts.size(); ++thread) threads.emplace_back(work, thread);
    for (std::thread& thread : threads) thread.join();
    return results;
}

size_t countHeld(const std::vector<HardCaseResult>& results) {
    return static_cast<size_t>(
        std::count_if(results.begin(), results.end(), [](const HardCaseResult& result) { return result.held(); }));
}

minirtc::LeverSettings seedSettings() {
    return {{"intersection", "moller_trumbore_epsilon"},
            {"ray_offset", "constant"},
            {"fresnel", "none"},
            {"nesting", "off"},
            {"absorption", "off"},
            {"dispersion", "off"}};
}

}  // namespace hard_cases
