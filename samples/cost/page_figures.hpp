// The page's table of all figures, for those who want to know.
#pragma once
#include "report.hpp"

namespace cost {

std::string figuresSection(const Report& report);

}  // namespace cost
