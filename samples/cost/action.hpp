// What to do about a setting, given which one the scene has.
#pragma once
#include "report.hpp"

namespace cost {

enum class Action {
    switchTo,       // recommended: less time for the same picture
    couldSwitch,    // the same by itself, but something else is recommended
    upgrade,        // a better picture that is worth its time
    keep,           // what the scene has is worth its time
    notNeeded,      // more accurate than what the scene has, for nothing
    choose,         // more of one is less of the other
    hardlyMatters,  // neither time nor picture change enough to be worth a word
};

struct Advice {
    Action action = Action::hardlyMatters;
    std::string reason;  // a few words
};

/// What to do about the setting that a comparison tries in place of the scene's own.
Advice adviceOn(const Report& report, const Comparison& comparison);

/// The same in words that name the settings: "Keep exact Fresnel", "Switch to 12 bounces", "Your choice".
std::string instruction(const Report& report, const Comparison& comparison);

/// Whether the setting that a comparison tries makes a better picture that is worth its time, also where it is to be taken for saving time.
bool isUpgrade(const Report& report, const Comparison& comparison);

/// An action in words: "switch", "could switch", "upgrade", "keep", "not needed", "your choice", "hardly matters".
std::string actionWords(Action action);

/// The same as a name, in JSON and as a class of the page: "switch", "could-switch", "upgrade", "keep", "not-needed", "choose", "hardly-matters".
std::string actionName(Action action);

/// The comparisons by what to do about them: first those that ask for a change. Levers stay together, by their leading comparison.
std::vector<size_t> byAction(const Report& report);

/// The two comparisons to know, each of another kind where there are such: what to change, what to keep, what to choose. What everybody knows, that samples
/// and integrators matter, comes last.
std::vector<size_t> findings(const Report& report);

}  // namespace cost
