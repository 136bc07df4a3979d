#include "embree_scene.hpp"

#include <utility>

#if MINIRT_HAVE_EMBREE

#include <embree3/rtcore.h>

bool EmbreeScene::available() {
    return true;
}

EmbreeScene::EmbreeScene(const std::vector<std::array<glm::vec3, 3>>& mesh, Mode mode)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * mesh.size()));
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), mesh.size()));
    for (size_t i = 0; i < 3 * mesh.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) positions[3 * i + axis] = mesh[i / 3][i % 3][axis];
        indices[i] = static_cast<uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    if (mode == Mode::robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
}

EmbreeScene::~EmbreeScene() {
    if (scene_) rtcReleaseScene(scene_);
    if (device_) rtcReleaseDevice(device_);
}

#else

bool EmbreeScene::available() {
    return false;
}
EmbreeScene::EmbreeScene(const std::vector<std::array<glm::vec3, 3>>&, Mode) {}
EmbreeScene::~EmbreeScene() = default;

#endif

EmbreeScene::EmbreeScene(EmbreeScene&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)), scene_(std::exchange(other.scene_, nullptr)) {}

EmbreeScene& EmbreeScene::operator=(EmbreeScene&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(scene_, other.scene_);
    return *this;
}
