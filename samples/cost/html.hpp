// Text and elements of a page.
#pragma once
#include <string>

namespace cost {

/// For text and attributes.
std::string escaped(const std::string& text);

/// `attributes` and `content` are HTML already.
std::string element(const std::string& name, const std::string& attributes, const std::string& content);

/// Of sentences: escaped, and numbers stay on the line of their unit.
std::string prose(const std::string& text);

/// A sentence beneath what it is about.
std::string small(const std::string& text);

}  // namespace cost
