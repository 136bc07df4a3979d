// Everything the sample scenes need, in one folder.
#pragma once
#include <filesystem>

namespace samples {

/// Creates `folder` if need be and fills it with the scene files, meshes, textures and the panorama: the same bytes every
/// time. Throws std::runtime_error, or std::filesystem::filesystem_error, when it cannot.
void generate(const std::filesystem::path& folder);

}  // namespace samples
