#include "output.hpp"

#include <fstream>
#include <stdexcept>

namespace samples {

void throwCannotWrite(const std::filesystem::path& path) {
    throw std::runtime_error(path.string() + ": cannot write; check that the folder exists and has room");
}

void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throwCannotWrite(path);
}

}  // namespace samples
