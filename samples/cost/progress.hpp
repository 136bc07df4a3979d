// On a terminal, one line that says what is going on.
#pragma once
#include <chrono>
#include <string>

namespace cost {

class Progress {
public:
    Progress();
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const std::string& what, size_t done, size_t all);
    void clear();
    double seconds() const;  // since the beginning

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    bool terminal_;
    bool shown_ = false;
};

}  // namespace cost
