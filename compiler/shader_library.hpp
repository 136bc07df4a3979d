// The shader sources, embedded in the compiler (cmake/EmbedShaders.cmake makes the table).
#pragma once
#include <map>
#include <string>

namespace minirtc {

/// Path below shaders/ -> text; "layout" is the slice of minirt.h that shaders share.
const std::map<std::string, std::string>& shaderLibrary();

}  // namespace minirtc
