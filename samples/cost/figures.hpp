// How figures are written in sentences and tables.
#pragma once
#include <string>

#include "../common/spread.hpp"

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

/// How far a time over another is known, by its quartiles: " (12 to 25 %)" more or less, from twice as long on " (1.98 to 2.11)"; "" where these are written
/// as the median is.
std::string timeRange(const Spread& ratio);

/// "19 % less time (12 to 25 %)", "2.06 times the time (1.98 to 2.11)".
std::string timeDifference(const Spread& ratio);

/// Of UTF-8, of which some letters are several bytes.
size_t letterCount(const std::string& text);

}  // namespace cost
