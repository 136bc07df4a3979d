// Which of several choices no other one beats in both time and error.
#pragma once
#include <cstddef>
#include <vector>

namespace cost {

struct Tradeoff {
    double time = 0;
    double error = 0;
};

/// Numbers of the points on the front, by growing time. Of equal points the first.
std::vector<size_t> paretoFront(const std::vector<Tradeoff>& points);

}  // namespace cost
