#include "oracle.hpp"

#if MINIRT_HAVE_EMBREE
#include <embree3/rtcore.h>
#endif

namespace oracle {

#if MINIRT_HAVE_EMBREE

Hit closestHit(const EmbreeScene& scene, const Ray& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r = {};
    r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z;
    r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
    r.ray.tnear = ray.tMin;
    r.ray.tfar = ray.tMax;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene.handle(), &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {r.ray.tfar, r.hit.primID};
}

#else

Hit closestHit(const EmbreeScene&, const Ray&) {
    return {};
}

#endif

}  // namespace oracle
