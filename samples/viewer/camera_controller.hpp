// A camera that flies through a scene: from keys and drags to a minirt_camera, without a window.
#pragma once
#include <minirt.h>

#include <functional>
#include <glm/vec3.hpp>

/// What the keys ask for: each axis -1, 0 or 1.
struct Motion {
    int forward = 0;
    int right = 0;
    int up = 0;
    bool fast = false;

    bool any() const { return forward != 0 || right != 0 || up != 0; }
};

/// W/S forward and back, D/A right and left, E/Q up and down, '+' (Shift) fast; opposite keys cancel.
Motion motionOf(const std::function<bool(char)>& isHeld);

/// Keeps the scene's camera bit for bit until it is moved. Turning is about the camera's own `up`, which stays: the horizon
/// never rolls, and the view stops short of straight up and down.
class CameraController {
public:
    /// Moves the length of the scene's bounding box in about ten seconds.
    explicit CameraController(const minirt_scene_desc& scene);

    /// Flies for `seconds`. True when the camera moved.
    bool fly(const Motion& motion, double seconds);
    /// Turns by a drag of so many window heights: to the right and downwards for positive values. True when the camera turned.
    bool turn(double right, double down);

    const minirt_camera& camera() const { return camera_; }

private:
    glm::dvec3 direction() const;

    minirt_camera camera_;
    double metresPerSecond_;
    glm::dvec3 up_;          // unit
    glm::dvec3 ahead_;       // unit, across up_: where yaw 0 looks
    glm::dvec3 right_;       // unit, right of ahead_
    double targetDistance_;  // metres
    double yaw_ = 0;         // radians to the right
    double pitch_ = 0;       // radians upwards
};
