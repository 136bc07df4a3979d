#include "camera_controller.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "key_script.hpp"

namespace {

minirt_scene_desc lookingAlong(const glm::dvec3& direction, const glm::dvec3& up = {0, 1, 0}) {
    minirt_scene_desc scene = {};
    for (int i = 0; i < 3; ++i) {
        scene.camera.position[i] = 1.5 - i;
        scene.camera.target[i] = scene.camera.position[i] + direction[i];
        scene.camera.up[i] = up[i];
        scene.bounds_max[i] = 10;
    }
    scene.camera.vfov = 60;
    return scene;
}

glm::dvec3 positionOf(const CameraController& c) {
    return {c.camera().position[0], c.camera().position[1], c.camera().position[2]};
}
glm::dvec3 targetOf(const CameraController& c) {
    return {c.camera().target[0], c.camera().target[1], c.camera().target[2]};
}
glm::dvec3 directionOf(const CameraController& c) {
    return glm::normalize(targetOf(c) - positionOf(c));
}

void checkNear(const glm::dvec3& a, const glm::dvec3& b) {
    CHECK(glm::distance(a, b) == doctest::Approx(0).epsilon(1e-12));
}

Motion motionOfKeys(const std::string& keys) {
    return motionOf([&](char key) { return keys.find(key) != std::string::npos; });
}

}  // namespace

TEST_CASE("the scene's camera stays bit for bit until it is moved") {
    const minirt_scene_desc scene = lookingAlong({0.3, -0.7, -1.9}, {0.1, 2, 0.3});
    CameraController controller(scene);
    CHECK_FALSE(controller.fly(motionOfKeys(""), 1));
    CHECK_FALSE(controller.fly(motionOfKeys("WS"), 1));
    CHECK_FALSE(controller.turn(0, 0));
    CHECK(std::memcmp(&controller.camera(), &scene.camera, sizeof scene.camera) == 0);
}

TEST_CASE("keys fly along the axes of the view at a tenth of the diagonal a second") {
    const double metres = std::sqrt(300.0) / 10 * 0.5;
    const struct {
        const char* keys;
        glm::dvec3 step;
    } cases[] = {{"W", {0, 0, -metres}}, {"S", {0, 0, metres}},  {"D", {metres, 0, 0}},       {"A", {-metres, 0, 0}},
                 {"E", {0, metres, 0}},  {"Q", {0, -metres, 0}}, {"W+", {0, 0, -4 * metres}}, {"WD", {metres, 0, -metres}}};
    for (const auto& c : cases) {
        CAPTURE(c.keys);
        CameraController controller(lookingAlong({0, 0, -3}));
        const glm::dvec3 position = positionOf(controller);
        const glm::dvec3 target = targetOf(controller);
        CHECK(controller.fly(motionOfKeys(c.keys), 0.5));
        checkNear(positionOf(controller) - position, c.step);
        checkNear(targetOf(controller) - target, c.step);
    }
}

TEST_CASE("a drag of the window's height turns by the field of view") {
    const double angle = 60.0 / 180.0 * std::acos(-1.0);
    CameraController controller(lookingAlong({0, 0, -3}));
    CHECK(controller.turn(1, 0));
    checkNear(directionOf(controller), {std::sin(angle), 0, -std::cos(angle)});
    controller.turn(-1, 1);
    checkNear(directionOf(controller), {0, -std::sin(angle), -std::cos(angle)});
    CHECK(glm::distance(positionOf(controller), targetOf(controller)) == doctest::Approx(3));
}

TEST_CASE("a first tiny turn continues from where the scene looks") {
    for (const glm::dvec3 up : {glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 5}, glm::dvec3{1, 1, 0.2}}) {
        CameraController controller(lookingAlong({0.4, -0.8, -2}, up));
        const glm::dvec3 before = directionOf(controller);
        controller.turn(1e-9, 0);
        CHECK(glm::distance(directionOf(controller), before) < 1e-8);
    }
}

TEST_CASE("the view never reaches straight up or down and never flips") {
    CameraController controller(lookingAlong({1, 0.2, -1}));
    const glm::dvec3 up{0, 1, 0};
    const glm::dvec3 right = glm::normalize(glm::cross(directionOf(controller), up));
    for (int i = 0; i < 100; ++i) {
        controller.turn(0, i < 50 ? -0.3 : 0.7);
        checkNear(glm::normalize(glm::cross(directionOf(controller), up)), right);
        CHECK(std::abs(directionOf(controller).y) < 0.9999);
    }
    CHECK(directionOf(controller).y < -0.999);
}

TEST_CASE("many turns leave the camera on the same place with a level horizon") {
    CameraController controller(lookingAlong({0, 0, -3}));
    const glm::dvec3 position = positionOf(controller);
    for (int i = 0; i < 6000; ++i) controller.turn(0.1, 0);  // a hundred full circles
    CHECK(positionOf(controller) == position);
    CHECK(glm::distance(directionOf(controller), {0, 0, -1}) < 1e-9);
}

TEST_CASE("a script holds its keys for its time and refuses what it does not know") {
    CameraController byScript(lookingAlong({0, 0, -3}));
    CameraController byHand(lookingAlong({0, 0, -3}));
    KeyScript script("WD 0.5");
    int frames = 0;
    for (; script.running(); ++frames) CHECK(script.play(byScript));
    byHand.fly(motionOfKeys("WD"), 0.5);
    CHECK(frames == 30);
    checkNear(positionOf(byScript), positionOf(byHand));
    CHECK_FALSE(KeyScript().running());
    for (const char* bad : {"", "W", "0.5", "X 0.5", "W 0", "W -1", "W 61", "W nan", "W 1 2"}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(KeyScript{bad}, std::invalid_argument);
    }
}
