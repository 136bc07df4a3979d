// Which of several choices no other one beats in both time and error.
#pragma once
#include "report.hpp"

namespace cost {

/// Whether a measurement is like the scene's own settings, in time and in the picture, but for chance and 2 %.
bool isLikeOwn(const Report& report, size_t measurement);

/// Numbers of the measurements on the front, by growing time: each takes longer than the one before it and is surely more accurate. What is like the scene's
/// own settings but for chance, or faster than these but for chance, is not on it.
std::vector<size_t> surelyOnFront(const Report& report);

}  // namespace cost
