#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "blob.hpp"
#include "error.hpp"

namespace minirtc {
namespace {

bool writeAll(int descriptor, const uint8_t* bytes, size_t size) {
    while (size > 0) {
        const ssize_t written = ::write(descriptor, bytes, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes += written;
        size -= static_cast<size_t>(written);
    }
    return true;
}

}  // namespace

void requireWritable(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw Error({path.string()}, "cannot be written: it is a folder", "name a file in it");
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (::access(folder.c_str(), W_OK) == 0) return;
    throw Error({path.string()}, std::string("cannot be written: ") + std::strerror(errno), "is its folder there and writable?");
}

void writeFile(const std::filesystem::path& path, const void* data, size_t size) {
    std::string temporary = path.string() + ".XXXXXX";
    const int descriptor = ::mkstemp(temporary.data());
    if (descriptor < 0)
        throw Error({path.string()}, std::string("cannot be written: ") + std::strerror(errno),
                    "is its folder there and writable?");
    constexpr mode_t kReadableByAll = 0644;
    bool good = writeAll(descriptor, static_cast<const uint8_t*>(data), size) && ::fchmod(descriptor, kReadableByAll) == 0 &&
                ::fsync(descriptor) == 0;
    int reason = errno;
    if (::close(descriptor) != 0 && good) {
        good = false;
        reason = errno;
    }
    if (good && ::rename(temporary.c_str(), path.c_str()) != 0) {
        good = false;
        reason = errno;
    }
    if (good) return;
    ::unlink(temporary.c_str());
    throw Error({path.string()}, std::string("cannot be written: ") + std::strerror(reason),
                "is there room, and is it no folder?");
}

}  // namespace minirtc
