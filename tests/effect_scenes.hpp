// Scenes that call for effects, as text: each alone, in pairs, and many side by side.
#pragma once
#include <string>
#include <vector>

#include "effects.hpp"
#include "support.hpp"

namespace test {

/// What calls for an effect. In `objects`, @ stands for the coordinates of its place.
struct Part {
    minirtc::Effect effect;
    std::string material;  // "name": {...}
    std::string objects;
    std::string light = "";
    std::string more = "";  // members of the scene
    bool path = false;      // needs the path tracer
};

using Parts = std::vector<Part>;

/// One for each effect but the layout of the hierarchy.
const Parts& parts();

std::string namesOf(const Parts& some);

enum class Tracer { whitted, path };

/// Whitted's where it can draw them.
Tracer tracerOf(const Parts& some);

/// Why no scene can hold both, or "".
std::string apart(const Part& a, const Part& b);

/// All pairs that are this tracer's, also those that no scene can hold.
std::vector<Parts> pairsOf(Tracer tracer);

/// Groups of parts that one scene can hold, few and the same in each run. Each pair of the tracer's that one scene can hold is in one of them.
std::vector<Parts> groupsOfPairs(Tracer tracer);

/// Parts side by side, on a floor and under light. A lamp lights them where no part does.
std::string sceneOf(const Parts& some, Tracer tracer);

/// The meshes and the picture that scenes of parts name.
void writeFilesOfParts(const TemporaryDir& dir);

}  // namespace test
