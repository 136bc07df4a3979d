// How figures are written in sentences and tables.
#pragma once
#include <string>

namespace cost {

/// To two significant digits at most, near the whole by what is missing: "2.1 %", "0.4 %", "21 %", "99.6 %". "0 %" is 0 alone.
std::string percent(double share);

/// To three significant digits: "0.00123", "45.6", "1230".
std::string number(double value);

}  // namespace cost
