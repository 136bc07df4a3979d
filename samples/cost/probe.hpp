// Settings of a rendering for a time: tried on a small picture, checked at the size that is wanted.
#pragma once
#include <string>

#include "budget.hpp"

namespace cost {

struct ProbedBudget {
    std::vector<Lever> levers;
    BudgetChoice choice;
    uint32_t sceneSamples = 0;       // the scene's own
    size_t tried = 0;                // settings,
    uint32_t width = 0, height = 0;  // in pictures of this size,
    double seconds = 0;              // in all, pipelines and the check at full size included
};

/// Measures the levers that the blob leaves open on this device: a few seconds where it is slow, and a picture or two of the full size. Throws std::runtime_error where
/// no settings fit.
ProbedBudget probeBudget(Device& device, const std::string& blob, uint32_t width, uint32_t height, double budgetMs);

}  // namespace cost
