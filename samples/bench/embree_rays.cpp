#include "embree_rays.hpp"

#include "parallel.hpp"
#include "timing.hpp"

#if MINIRT_HAVE_EMBREE
#include <embree3/rtcore.h>
#endif

namespace bench {

#if MINIRT_HAVE_EMBREE

namespace {

constexpr size_t kChunk = 4096;  // rays that a thread takes at once

RTCRay embreeRay(const Ray& ray) {
    RTCRay r = {};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tfar = ray.tMax;
    r.mask = ~0u;
    return r;
}

Hit closestHit(RTCScene scene, RTCIntersectContext& context, const Ray& ray) {
    RTCRayHit r;
    r.ray = embreeRay(ray);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &r);
    return {r.ray.tfar, r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kNoHit : r.hit.primID};
}

/// tfar becomes minus infinity where the ray is occluded.
Hit anyHit(RTCScene scene, RTCIntersectContext& context, const Ray& ray) {
    RTCRay r = embreeRay(ray);
    rtcOccluded1(scene, &context, &r);
    return {r.tfar, r.tfar < 0 ? 0u : kNoHit};
}

void fill(RTCRay8& packet, const Ray* rays) {
    for (int i = 0; i < 8; ++i) {
        packet.org_x[i] = rays[i].origin.x, packet.org_y[i] = rays[i].origin.y, packet.org_z[i] = rays[i].origin.z;
        packet.dir_x[i] = rays[i].direction.x, packet.dir_y[i] = rays[i].direction.y, packet.dir_z[i] = rays[i].direction.z;
        packet.tnear[i] = 0, packet.tfar[i] = rays[i].tMax, packet.time[i] = 0;
        packet.mask[i] = ~0u, packet.id[i] = 0, packet.flags[i] = 0;
    }
}

alignas(32) constexpr int kAllValid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};

void closestHits(RTCScene scene, RTCIntersectContext& context, const Ray* rays, Hit* hits) {
    RTCRayHit8 packet;
    fill(packet.ray, rays);
    for (int i = 0; i < 8; ++i) packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect8(kAllValid, scene, &context, &packet);
    for (int i = 0; i < 8; ++i)
        hits[i] = {packet.ray.tfar[i], packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? kNoHit : packet.hit.primID[i]};
}

void anyHits(RTCScene scene, RTCIntersectContext& context, const Ray* rays, Hit* hits) {
    RTCRay8 packet;
    fill(packet, rays);
    rtcOccluded8(kAllValid, scene, &context, &packet);
    for (int i = 0; i < 8; ++i) hits[i] = {packet.tfar[i], packet.tfar[i] < 0 ? 0u : kNoHit};
}

}  // namespace

struct EmbreeRays::Insides {
    EmbreeScene scene;
    minirtc::ThreadPool pool{0};
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    bool coherent = false;

    Insides(const Triangles& mesh, EmbreeScene::Mode mode) : scene(mesh, mode) {}

    void traceChunk(size_t begin, size_t end, bool any, Packing packing) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        size_t i = begin;
        if (packing == Packing::eight)
            for (; i + 8 <= end; i += 8) (any ? anyHits : closestHits)(scene.handle(), context, &rays[i], &hits[i]);
        for (; i < end; ++i) hits[i] = (any ? anyHit : closestHit)(scene.handle(), context, rays[i]);
    }
};

EmbreeRays::EmbreeRays(const Triangles& mesh, EmbreeScene::Mode mode) : insides_(new Insides(mesh, mode)) {}

EmbreeRays::~EmbreeRays() = default;

void EmbreeRays::setRays(const std::vector<Ray>& rays, bool coherent) {
    insides_->rays = rays;
    insides_->hits.assign(rays.size(), {});
    insides_->coherent = coherent;
}

double EmbreeRays::trace(bool anyHit, Packing packing) {
    const double start = nowMs();
    const size_t count = insides_->rays.size();
    insides_->pool.parallelFor((count + kChunk - 1) / kChunk, [&](size_t chunk) {
        insides_->traceChunk(chunk * kChunk, std::min(count, (chunk + 1) * kChunk), anyHit, packing);
    });
    return nowMs() - start;
}

const std::vector<Hit>& EmbreeRays::hits() const {
    return insides_->hits;
}

#else

struct EmbreeRays::Insides {
    std::vector<Hit> hits;
};
EmbreeRays::EmbreeRays(const Triangles&, EmbreeScene::Mode) : insides_(new Insides) {}
EmbreeRays::~EmbreeRays() = default;
void EmbreeRays::setRays(const std::vector<Ray>&, bool) {}
double EmbreeRays::trace(bool, Packing) {
    return 0;
}
const std::vector<Hit>& EmbreeRays::hits() const {
    return insides_->hits;
}

#endif

}  // namespace bench
