// What several tests need: inputs outside the project, temporary folders, skipping.
#pragma once
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace test {

/// Marks the running case as skipped: it shows as such in ctest. Return from the case after it.
void skip(const std::string& why);

/// The folder of real scenes beside the project; it may be absent.
inline std::filesystem::path sharedDir() {
    return MINIRT_SHARED_DIR;
}

/// True when `path` below sharedDir() exists; else skips the case.
inline bool haveShared(const std::string& path = "scenes") {
    if (std::filesystem::exists(sharedDir() / path)) return true;
    skip("needs ../shared/" + path);
    return false;
}

/// A fresh folder that goes away with the object.
class TemporaryDir {
public:
    TemporaryDir() {
        std::string pattern = (std::filesystem::temp_directory_path() / "minirt-test-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TemporaryDir() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryDir(const TemporaryDir&) = delete;
    TemporaryDir& operator=(const TemporaryDir&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const std::filesystem::path file = path_ / name;
        std::ofstream(file, std::ios::binary) << text;
        return file;
    }

private:
    std::filesystem::path path_;
};

}  // namespace test
