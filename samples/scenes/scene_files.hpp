// The scene files of this folder, compiled in (scene_files.cpp.in).
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace samples {

/// File name and text, sorted by name.
const std::vector<std::pair<std::string, std::string>>& sceneFiles();

}  // namespace samples
