// Lever `precision`: the end of what levers/double_begin.glsl began. Points become floats, which is then nearly all of their error.

#ifdef PRECISION_DOUBLE

#undef real
#define real float
#undef vec3
#undef SurfacePoint
#undef errorGamma

SurfacePoint toFloat(DoublePoint point) {
    vec3 p = vec3(point.p);
    return SurfacePoint(p, errorGamma(2) * abs(p) + vec3(point.pError), vec3(point.ng));
}

SurfacePoint trianglePointByDoubles(TriangleHit hit, vec3 v0, vec3 v1, vec3 v2) { return toFloat(trianglePoint(hit, v0, v1, v2)); }

/// A direction of unit length in floats is not so in doubles.
SphereHit intersectSphereByDoubles(vec3 origin, vec3 direction, vec3 center, float radius, float tMax) {
    return intersectSphere(origin, normalize(dvec3(direction)), center, radius, tMax);
}

SurfacePoint spherePointByDoubles(vec3 origin, vec3 direction, float t, vec3 center, float radius) {
    return toFloat(spherePoint(origin, normalize(dvec3(direction)), t, center, radius));
}

#define trianglePoint trianglePointByDoubles
#define intersectSphere intersectSphereByDoubles
#define spherePoint spherePointByDoubles

#endif
