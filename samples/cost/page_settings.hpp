// The page's table of settings: what the scene has, what else was tried, and what to do.
#pragma once
#include "action.hpp"

namespace cost {

/// An action as a chip in its colour.
std::string chip(Action action);

std::string settingsSection(const Report& report);

}  // namespace cost
