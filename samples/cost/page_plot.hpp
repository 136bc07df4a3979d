// The page's part with error against time, on a desk and on a phone.
#pragma once
#include <string>

#include "half_time.hpp"

namespace cost {

/// "own", "lever" or "combination": the class of what shows a measurement.
std::string groupOf(const Report& report, size_t measurement);

/// The number of what halves the time, where it was not measured; it stands behind all measurements.
constexpr const char* kExpectedNumber = "½";

/// A measurement, or what is expected, by its number and name.
std::string numberedName(const std::string& group, const std::string& number, const std::string& name);

/// In tables, with the mark that the plot has.
std::string recommendedBadge();
std::string halfTimeBadge(const HalfTime& half);

std::string plotSection(const Report& report);

}  // namespace cost
