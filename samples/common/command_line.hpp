// What the samples' command lines share.
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Wrong usage in one line; for CLI::App::failure_message.
std::string oneLineFailure(const CLI::App* app, const CLI::Error& error);

/// WIDTHxHEIGHT of 1 to 16384 each. Throws UsageError.
void parseSize(const std::string& text, uint32_t& width, uint32_t& height);
