// The report as one page that needs nothing else.
#pragma once
#include <string>

#include "report.hpp"

namespace cost {

std::string page(const Report& report);

}  // namespace cost
