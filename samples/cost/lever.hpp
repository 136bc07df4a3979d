// What can be set cheaper or more accurate, and a choice of it all.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace cost {

enum class LeverKind { baked, integrator, depth, cutoff, lightSampling, samples };

struct Setting {
    std::string name;   // on the command line and in JSON
    std::string words;  // in a sentence, such as "8 bounces"
    double value = 0;   // of the field of minirt_render_desc that it is for
};

struct Lever {
    LeverKind kind = LeverKind::baked;
    std::string name;               // on the command line and in JSON
    std::string title;              // in a table
    std::vector<Setting> settings;  // the cheapest first
    size_t initial = 0;             // the scene's own
    size_t best = 0;                // the reference's
    bool plural = false;            // "8 bounces cost", "exact Fresnel costs"
    std::string idle;               // why it can change nothing here; "": it may
};

/// The number of a setting for each lever, in the order of the table.
using Configuration = std::vector<size_t>;

Configuration initialConfiguration(const std::vector<Lever>& levers);
Configuration bestConfiguration(const std::vector<Lever>& levers);

/// The same with one lever at another setting.
Configuration with(Configuration configuration, size_t lever, size_t setting);

/// The number of the lever of this kind, or levers.size().
size_t findLever(const std::vector<Lever>& levers, LeverKind kind);

}  // namespace cost
