// Files that the generator writes.
#pragma once
#include <filesystem>
#include <string>

namespace samples {

/// Throws std::runtime_error: what a user can do when `path` cannot be written.
[[noreturn]] void throwCannotWrite(const std::filesystem::path& path);

/// Byte for byte. Throws std::runtime_error when the file cannot be written.
void writeText(const std::filesystem::path& path, const std::string& text);

}  // namespace samples
