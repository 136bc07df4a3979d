// Loading a blob, beside copying as many bytes and no more.
#pragma once
#include <filesystem>

#include "timing.hpp"

struct minirt_context;

namespace bench {

/// Milliseconds. Copies go from memory to memory and from there to the device, as uploads of the runtime do.
struct LoadResult {
    uint64_t bytes = 0;
    Spread load;        // of a file that the system has in memory: opened, checked, uploaded
    Spread copy;        // into buffers that are made for it, as a load makes its own
    Spread copyAgain;   // into buffers that have been written before
    Spread ratio;       // copy / load, round by round
    Spread ratioAgain;  // copyAgain / load
};

/// Throws std::runtime_error.
LoadResult benchLoad(minirt_context* context, const std::filesystem::path& blob, int rounds);

}  // namespace bench
