// Triangles in Embree 3, for measuring beside it and for judging by it.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <vector>

struct RTCSceneTy;
struct RTCDeviceTy;

class EmbreeScene {
public:
    enum class Mode { robust, fast };  // RTC_SCENE_FLAG_ROBUST or Embree's default

    /// False where minirt was built without Embree: then nothing else may be called.
    static bool available();

    /// Builds at medium quality, Embree's default. A triangle's place in `mesh` is its primitive number.
    EmbreeScene(const std::vector<std::array<glm::vec3, 3>>& mesh, Mode mode);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&& other) noexcept;
    EmbreeScene& operator=(EmbreeScene&& other) noexcept;

    /// For Embree's functions; the object owns it.
    RTCSceneTy* handle() const { return scene_; }

private:
    RTCDeviceTy* device_ = nullptr;
    RTCSceneTy* scene_ = nullptr;
};
