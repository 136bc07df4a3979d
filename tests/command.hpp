// Runs the project's programs as a user does, with their output in hand.
#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support.hpp"

namespace test {

inline std::string readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Outcome {
    int exitCode = -1;  // -1: it did not exit by itself
    std::string out;
    std::string err;
};

using Words = std::vector<std::string>;

inline std::string shellCommand(const Words& words) {
    std::string line;
    for (const std::string& word : words) {
        line += line.empty() ? "'" : " '";
        for (char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += "'";
    }
    return line;
}

/// Runs a program with both outputs piped away. `environment`: words such as NAME=VALUE.
inline Outcome run(const Words& words, const Words& environment = {}) {
    const TemporaryDir dir;
    Words all = {"env"};
    all.insert(all.end(), environment.begin(), environment.end());
    all.insert(all.end(), words.begin(), words.end());
    const auto out = dir.path() / "out";
    const auto err = dir.path() / "err";
    const int status = std::system((shellCommand(all) + " >" + out.string() + " 2>" + err.string() + " </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(out), readFile(err)};
}

/// True when there is a Vulkan device; else skips the case.
inline bool haveDevice() {
    if (run({MINIRTC, "devices"}).exitCode == 0) return true;
    skip("needs a Vulkan device");
    return false;
}

}  // namespace test
