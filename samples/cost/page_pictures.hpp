// Pictures that travel inside a page.
#pragma once
#include "../common/picture_file.hpp"

namespace cost {

/// sRGB.
std::string pictureUri(const Picture& picture);

/// How many 8-bit sRGB steps each pixel is off, of its worst channel: black up to kUnseenSteps, then through the colours of differenceScale().
std::string differenceUri(const Picture& picture, const Picture& reference);

/// A strip that shows the colours of a difference map, from the smallest to the largest.
std::string differenceScaleUri();

/// RFC 4648.
std::string base64(const std::vector<uint8_t>& bytes);

}  // namespace cost
