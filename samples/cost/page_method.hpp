// The page's last parts: hard cases, and how all of it was measured.
#pragma once
#include "report.hpp"

namespace cost {

/// "" where these were not asked for.
std::string hardCasesSection(const Report& report);

/// `bounds`: whether the page marks figures by ≤.
std::string methodSection(const Report& report, bool bounds);

}  // namespace cost
