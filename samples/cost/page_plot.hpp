// The page's part with error against time, on a desk and on a phone.
#pragma once
#include <string>

#include "report.hpp"

namespace cost {

/// "own", "lever" or "combination": the class of what shows a measurement.
std::string groupOf(const Report& report, size_t measurement);

std::string plotSection(const Report& report);

}  // namespace cost
