// The cases by what they are about. Each gives its figure.
#pragma once
#include <functional>

#include "stage.hpp"

namespace hard_cases {

struct HardCase {
    std::string name;
    std::string what;
    std::string unit;
    double bound;
    std::function<double(Stage&)> figure;
};

std::vector<HardCase> intersectionCases();
std::vector<HardCase> originCases();
std::vector<HardCase> opticsCases();
std::vector<HardCase> mediaCases();
std::vector<HardCase> crossingCases();

}  // namespace hard_cases
