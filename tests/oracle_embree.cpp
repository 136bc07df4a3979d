#include "oracle.hpp"

#if MINIRT_HAVE_EMBREE
#include <embree3/rtcore.h>
#endif

namespace oracle {

#if MINIRT_HAVE_EMBREE

struct EmbreeScene::Handles {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    ~Handles() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

bool EmbreeScene::available() {
    return true;
}

EmbreeScene::EmbreeScene(const Mesh& mesh) : handles_(new Handles) {
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * mesh.size()));
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), mesh.size()));
    for (size_t i = 0; i < 3 * mesh.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) positions[3 * i + axis] = mesh[i / 3][i % 3][axis];
        indices[i] = static_cast<uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(handles_->scene);
}

Hit EmbreeScene::closestHit(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r = {};
    r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z;
    r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
    r.ray.tnear = ray.tMin;
    r.ray.tfar = ray.tMax;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(handles_->scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {r.ray.tfar, r.hit.primID};
}

#else

struct EmbreeScene::Handles {};
bool EmbreeScene::available() {
    return false;
}
EmbreeScene::EmbreeScene(const Mesh&) {}
Hit EmbreeScene::closestHit(const Ray&) const {
    return {};
}

#endif

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

}  // namespace oracle
