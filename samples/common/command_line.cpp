#include "command_line.hpp"

#include <cstdio>

std::string oneLineFailure(const CLI::App* app, const CLI::Error& error) {
    return app->get_name() + ": " + error.what() + "; see " + app->get_name() + " --help\n";
}

void parseSize(const std::string& text, uint32_t& width, uint32_t& height) {
    constexpr uint32_t kLargest = 16384;
    int used = 0;
    const bool good =
        std::sscanf(text.c_str(), "%5ux%5u%n", &width, &height, &used) == 2 && used == static_cast<int>(text.size());
    if (!good || width == 0 || height == 0 || width > kLargest || height > kLargest)
        throw UsageError("--size: give WIDTHxHEIGHT of 1 to 16384 each, such as 640x480");
}
