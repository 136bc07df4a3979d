#include "start_bench.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "stage.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;

fs::path renderProgram() {
    fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "minirt-render";
    if (!fs::exists(program)) throw std::runtime_error(program.string() + ": is missing, starts cannot be measured");
    return program;
}

/// Milliseconds from the creation of the process to its end.
double processMs(std::vector<std::string> words) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    int status = 0;
    const double begin = nowMs();
    if (posix_spawn(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0 ||
        waitpid(process, &status, 0) != process || status != 0)
        throw std::runtime_error(words[0] + " did not render " + words[1]);
    return nowMs() - begin;
}

StartSpreads spreadsOf(const std::vector<StartResult>& starts) {
    const auto spread = [&](double StartResult::*part) {
        std::vector<double> values;
        values.reserve(starts.size());
        for (const StartResult& one : starts) values.push_back(one.*part);
        return spreadOf(values);
    };
    return {spread(&StartResult::process), spread(&StartResult::load), spread(&StartResult::upload),
            spread(&StartResult::pipeline)};
}

}  // namespace

StartResult start(const std::string& device, const fs::path& blob, const fs::path& cache) {
    const TemporaryFolder folder;
    const std::string stats = (folder.path() / "stats.json").string();
    useShaderCache(cache);
    std::vector<std::string> words = {renderProgram().string(),
                                      blob.string(),
                                      "-o",
                                      (folder.path() / "picture.png").string(),
                                      "--size",
                                      "64x64",
                                      "--spp",
                                      "1",
                                      "--stats",
                                      stats};
    if (!device.empty()) words.insert(words.end(), {"--device", device});
    StartResult result;
    result.process = processMs(words);
    std::ifstream file(stats);
    const nlohmann::json json = nlohmann::json::parse(file);
    result.load = json.at("load_ms");
    result.upload = json.at("upload_ms");
    result.pipeline = json.at("pipeline_ms");
    return result;
}

StartsResult benchStarts(const std::string& device, const fs::path& blob, int rounds) {
    const TemporaryFolder filled;
    start(device, blob, filled.path());
    std::vector<StartResult> cold, second;
    for (int round = 0; round < rounds; ++round) {
        const TemporaryFolder empty;
        cold.push_back(start(device, blob, empty.path()));
        second.push_back(start(device, blob, filled.path()));
    }
    return {spreadsOf(cold), spreadsOf(second)};
}

}  // namespace bench
