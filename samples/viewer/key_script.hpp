// Keys that are held for a while with nobody at the keyboard, so that tests can move the camera.
#pragma once
#include <string>

#include "camera_controller.hpp"

class KeyScript {
public:
    KeyScript() = default;
    /// "KEYS SECONDS", such as "WD 0.5"; the keys are those of motionOf. Throws std::invalid_argument.
    explicit KeyScript(const std::string& text);

    bool running() const { return frames_ > 0; }
    /// One frame of a sixtieth of a second. True when the camera moved.
    bool play(CameraController& camera);

private:
    Motion motion_;
    int frames_ = 0;
};
