// The page's table of all figures, for those who want to know, and what both tables share.
#pragma once
#include "half_time.hpp"

namespace cost {

/// A cell: the time over that of the scene's own settings, and how far it is known.
std::string timeContent(const Spread& time);

/// Likewise of what halves the time and was not measured.
std::string expectedTimeContent(const HalfTime& half);

/// Whether a figure is marked ≤, as errorFigure() does.
bool hasBound(const std::string& html);

/// What ≤ means beside a table; "" where none is in it.
std::string boundKey(const Report& report, const std::string& table);

std::string figuresSection(const Report& report);

}  // namespace cost
