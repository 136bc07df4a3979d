// Ray-sphere intersection that keeps its precision far away and for huge spheres
// (Haines, Guenther, Akenine-Moeller, Ray Tracing Gems ch. 7). GLSL and C++ (tests/shader_source.hpp).

struct SphereHit {
    bool hit;
    real t;
};

/// Nearest hit with 0 < t < tMax on the sphere, from outside or inside. `direction` is of unit length.
SphereHit intersectSphere(vec3 origin, vec3 direction, vec3 center, real radius, real tMax) {
    vec3 f = origin - center;
    real b = -dot(f, direction);
    vec3 closest = f + direction * b;  // from the centre to the ray's nearest point: no cancellation of large squares
    real discriminant = radius * radius - dot(closest, closest);
    real c = dot(f, f) - radius * radius;
    real root = sqrt(max(discriminant, real(0)));
    real q = b + (b < real(0) ? -root : root);
    real t0 = q != real(0) ? c / q : real(0);
    real t1 = q;
    real near = min(t0, t1);
    real far = max(t0, t1);
    SphereHit hit;
    hit.t = near > real(0) ? near : far;
    hit.hit = discriminant >= real(0) && hit.t > real(0) && hit.t < tMax;
    return hit;
}

/// The point of a hit, brought back onto the sphere (pbrt-v4 section 6.8.5).
SurfacePoint spherePoint(vec3 origin, vec3 direction, real t, vec3 center, real radius) {
    vec3 fromCenter = origin + direction * t - center;
    fromCenter *= radius / max(length(fromCenter), real(1e-30));
    SurfacePoint point;
    point.p = center + fromCenter;
    point.pError = errorGamma(6) * (abs(fromCenter) + abs(center));
    point.ng = fromCenter / radius;
    return point;
}
