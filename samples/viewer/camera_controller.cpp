#include "camera_controller.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace {

constexpr double kSecondsAcross = 10;
constexpr double kFast = 4;
constexpr double kSteepest = 1.55;  // radians, just below a right angle

glm::dvec3 vectorOf(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

void store(const glm::dvec3& from, double (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

}  // namespace

Motion motionOf(const std::function<bool(char)>& isHeld) {
    const auto axis = [&](char positive, char negative) { return int{isHeld(positive)} - int{isHeld(negative)}; };
    return {axis('W', 'S'), axis('D', 'A'), axis('E', 'Q'), isHeld('+')};
}

CameraController::CameraController(const minirt_scene_desc& scene) : camera_(scene.camera) {
    metresPerSecond_ = glm::distance(vectorOf(scene.bounds_min), vectorOf(scene.bounds_max)) / kSecondsAcross;
    const glm::dvec3 toTarget = vectorOf(camera_.target) - vectorOf(camera_.position);
    targetDistance_ = glm::length(toTarget);
    up_ = glm::normalize(vectorOf(camera_.up));
    right_ = glm::normalize(glm::cross(toTarget, up_));
    ahead_ = glm::cross(up_, right_);
    pitch_ = std::asin(std::clamp(glm::dot(toTarget, up_) / targetDistance_, -1.0, 1.0));
}

glm::dvec3 CameraController::direction() const {
    return std::cos(pitch_) * (std::cos(yaw_) * ahead_ + std::sin(yaw_) * right_) + std::sin(pitch_) * up_;
}

bool CameraController::fly(const Motion& motion, double seconds) {
    if (!motion.any() || seconds <= 0) return false;
    const glm::dvec3 sideways = std::cos(yaw_) * right_ - std::sin(yaw_) * ahead_;
    const glm::dvec3 velocity = double(motion.forward) * direction() + double(motion.right) * sideways + double(motion.up) * up_;
    const glm::dvec3 step = velocity * (metresPerSecond_ * (motion.fast ? kFast : 1.0) * seconds);
    store(vectorOf(camera_.position) + step, camera_.position);
    store(vectorOf(camera_.target) + step, camera_.target);
    return true;
}

bool CameraController::turn(double right, double down) {
    if (right == 0 && down == 0) return false;
    const double radiansPerHeight = glm::radians(camera_.vfov);
    yaw_ = std::remainder(yaw_ + right * radiansPerHeight, glm::radians(360.0));
    pitch_ = std::clamp(pitch_ - down * radiansPerHeight, -kSteepest, kSteepest);
    store(vectorOf(camera_.position) + targetDistance_ * direction(), camera_.target);
    return true;
}
