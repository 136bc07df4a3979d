// Settings of a rendering for a time: tried on a small picture, checked at the size that is wanted.
#pragma once
#include <string>

#include "budget.hpp"

namespace cost {

struct ProbedBudget {
    std::vector<Lever> levers;
    BudgetChoice choice;
};

/// Measures the levers that the blob leaves open on this device, for some multiples of `budgetMs` and at least a second. Throws std::runtime_error where
/// no settings fit.
ProbedBudget probeBudget(Device& device, const std::string& blob, uint32_t width, uint32_t height, double budgetMs);

}  // namespace cost
