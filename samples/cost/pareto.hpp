// Which of several choices no other one beats in both time and error.
#pragma once
#include "comparison.hpp"

namespace cost {

struct Tradeoff {
    double time = 0;
    double error = 0;
};

/// Numbers of the points on the front, by growing time. Of equal points the first.
std::vector<size_t> paretoFront(const std::vector<Tradeoff>& points);

/// Numbers of the measurements on the front, by growing time; the first one is of the scene's own settings. What is like these but for chance beats nothing, and
/// a time that cannot be told from theirs counts as theirs.
std::vector<size_t> surelyOnFront(const std::vector<Measurement>& measurements);

}  // namespace cost
