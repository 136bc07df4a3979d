// Lever `ray_offset`. Default: offsetRayOrigin() of common/numerics.glsl. Else what miniRTRender did: a constant, and later one that grows with the
// distance to the camera (getDynamicEpsilon). Neither knows how large the error of the point is.

#if defined(RAY_OFFSET_CONSTANT) || defined(RAY_OFFSET_DISTANCE_SCALED)

vec3 offsetByGuess(vec3 p, vec3 pError, vec3 ng, vec3 w) {
#ifdef RAY_OFFSET_CONSTANT
    float size = 1e-3;
#else
    float size = 1e-5 + 1e-4 * distance(p, frame.position.xyz);
#endif
    return p + (dot(w, ng) < 0.0 ? -size : size) * ng;
}

#define offsetRayOrigin offsetByGuess

#endif
