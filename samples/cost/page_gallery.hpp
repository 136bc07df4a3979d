// The page's pictures, and where they are wrong.
#pragma once
#include "report.hpp"

namespace cost {

/// A link to the picture of a measurement around HTML; without one where the page does not show it.
std::string linkToPicture(const Report& report, size_t measurement, const std::string& html);

std::string gallerySection(const Report& report);

}  // namespace cost
