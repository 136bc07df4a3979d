#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace cost {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::show(const std::string& what, size_t done, size_t all) {
    if (!terminal_) return;
    std::fprintf(stderr, "\r%5.0f s  %s, %zu of %zu\033[K", seconds(), what.c_str(), done, all);
    shown_ = true;
}

void Progress::clear() {
    if (shown_) std::fprintf(stderr, "\r\033[K");
    shown_ = false;
}

double Progress::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace cost
