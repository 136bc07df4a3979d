// A GPU that is to be timed has to be awake.
#pragma once
#include <chrono>

/// How long it is kept busy first. One that waits lowers its clock, an H100 from 1980 to 345 MHz within a second or so, and takes some
/// tenths of a second of work to raise it again (docs/performance.md).
constexpr double kWakeMs = 1000;

/// Calls `run` until `busyMs` have passed, at least once; returns what the last call did.
template <typename Run>
auto runFor(double busyMs, const Run& run) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(busyMs));
    auto last = run();
    while (Clock::now() < end) last = run();
    return last;
}
