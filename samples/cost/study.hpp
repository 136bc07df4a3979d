// A whole study: reference, levers one at a time, combinations, what follows from them.
#pragma once
#include "report.hpp"

namespace cost {

struct StudyOptions {
    uint32_t width = 0, height = 0;  // 0: the scene's shape, with as many pixels as 256x192
    uint32_t samples = 0;            // of the scene's own settings; 0: the scene's, or fewer to end in time
    uint32_t repeats = 5;
    double seconds = 300;  // aimed at; a slow device takes longer rather than measure nothing
    size_t combinations = 12;
    double budgetMs = 0;  // 0: none
};

/// `scenes` holds the levers of the bake; those of the rendering are added. Fills all of a report but its first three fields and the device.
void study(Scenes& scenes, const BlobFacts& facts, bool cpuDevice, const StudyOptions& options, Progress& progress,
           Report& report);

}  // namespace cost
