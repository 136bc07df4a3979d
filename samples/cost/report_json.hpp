// The report as JSON.
#pragma once
#include <string>

#include "report.hpp"

namespace cost {

std::string reportJson(const Report& report);

}  // namespace cost
