// The accuracy levers: what a picture can trade for time. Their defaults are the accurate settings; the cheap ones exist to be compared.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "effects.hpp"
#include "scene.hpp"

namespace minirtc {

/// Where a lever is set: `minirtc bake --set`, or an option of minirt-render.
enum class LeverTime { bake, render };

struct LeverSetting {
    std::string name;
    std::string what;    // one line: what it does, and its source
    std::string define;  // of the kernels, which switches it on; "": the default's code, or effects that are in or out
};

struct Lever {
    std::string name;
    LeverTime when;
    std::string what;
    std::vector<LeverSetting> settings;  // from the cheapest to the most accurate; none: a number
    std::string byDefault;               // a setting; of a number, what counts where none is given
    std::string option;                  // of minirt-render: "--max-depth"
};

/// All levers, in the order in which they are listed.
const std::vector<Lever>& levers();

/// Of those that are set when baking.
std::vector<std::string> bakeLeverNames();
std::vector<std::string> settingNames(const Lever& lever);

/// Throws Error, which names the nearest one.
const Lever& findLever(const std::string& name);

/// Throws Error where the lever is unknown, is set when rendering, or has no such setting.
void requireSetting(const std::string& lever, const std::string& setting);

/// Reads "LEVER=SETTING" into `settings`. Throws Error.
void readSetting(const std::string& text, LeverSettings& settings);

/// The setting of a lever of baking: the one asked for, else what the scene or the default says.
std::string settingOf(const Lever& lever, const LeverSettings& asked, const Scene& scene);

/// What the levers say of how volumes nest and light disperses takes the place of what the scene says.
void applyMethods(const LeverSettings& asked, EffectSet& effects);

/// Leaves out the effects whose lever is off, and notes all settings that are not the default.
void applyToEffects(const LeverSettings& asked, EffectSet& effects);

/// The names that the kernels are compiled with.
std::vector<std::string> definesOf(const LeverSettings& settings);

/// Whether a lever can change what any of `integrators` draws of a scene that calls for `effects`, and why.
struct Applicability {
    bool applies = false;
    std::string reason;
};
Applicability applies(const Lever& lever, const EffectSet& effects, const std::vector<Integrator>& integrators);

}  // namespace minirtc
