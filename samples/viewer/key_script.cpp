#include "key_script.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace {
constexpr double kFramesPerSecond = 60;
constexpr double kLongest = 60;  // seconds
}  // namespace

KeyScript::KeyScript(const std::string& text) {
    std::istringstream words(text);
    std::string keys;
    double seconds = 0;
    const bool read = words >> keys >> seconds && (words >> std::ws).eof();
    if (!read || keys.find_first_not_of("WASDEQ+") != std::string::npos || !(seconds > 0 && seconds <= kLongest))
        throw std::invalid_argument("give keys of WASDEQ+ and seconds up to 60, such as \"WD 0.5\"");
    motion_ = motionOf([&](char key) { return keys.find(key) != std::string::npos; });
    frames_ = static_cast<int>(std::ceil(seconds * kFramesPerSecond));
}

bool KeyScript::play(CameraController& camera) {
    --frames_;
    return camera.fly(motion_, 1 / kFramesPerSecond);
}
