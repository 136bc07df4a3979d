// How figures are written in sentences and tables.
#pragma once
#include <string>

namespace cost {

/// To two significant digits at most, near the whole by what is missing: "2.1 %", "0.4 %", "21 %", "99.6 %". "0 %" is 0 alone.
std::string percent(double share);

/// To three significant digits: "0.00123", "45.6", "1230".
std::string number(double value);

/// An error, or "≤ 0.000300" where it is no more than that of the reference, `floor`, and so not to be believed.
std::string errorFigure(double error, double floor);

/// "the error rises from 0.0100 to 0.0200".
std::string errorChange(double from, double to, double floor);

/// A time over that of the scene's own settings, 1: "−30 %", "+4.1 %", from twice as long on "2.06 ×".
std::string relativeTime(double ratio);

/// Of UTF-8, of which some letters are several bytes.
size_t letterCount(const std::string& text);

}  // namespace cost
