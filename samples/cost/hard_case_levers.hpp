// The hard cases of rounding with each setting of the levers: what a scene that looks fine does not show.
#pragma once
#include "../common/device.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace cost {

/// With the defaults, then each other setting of a lever of the bake alone, then miniRTRender's.
std::vector<HardCases> runHardCases(const Device& device, Progress& progress);

}  // namespace cost
