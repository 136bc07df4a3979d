// The page's table of settings: what the scene has, what else was tried, and what to do.
#pragma once
#include "report.hpp"

namespace cost {

std::string settingsSection(const Report& report);

}  // namespace cost
