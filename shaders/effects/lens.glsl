// Effect `lens`: camera rays start on the disk of a thin lens and meet in the plane in focus. Identity: a pinhole.

struct CameraRay {
    vec3 origin;
    vec3 direction;
};

#ifdef EFFECT_LENS

/// `at`: in the picture, -1 to 1, y down; `u` picks the point of the lens.
CameraRay cameraRay(vec2 at, vec2 u) {
    vec3 towards = frame.forward.xyz + at.x * frame.right.xyz - at.y * frame.up.xyz;
    vec2 onLens = concentricDisk(u) * frame.forward.w;
    vec3 origin = frame.position.xyz + onLens.x * normalize(frame.right.xyz) + onLens.y * normalize(frame.up.xyz);
    vec3 inFocus = frame.position.xyz + towards * frame.right.w;
    return CameraRay(origin, normalize(frame.forward.w > 0.0 ? inFocus - origin : towards));
}

#else

CameraRay cameraRay(vec2 at, vec2 u) {
    return CameraRay(frame.position.xyz, normalize(frame.forward.xyz + at.x * frame.right.xyz - at.y * frame.up.xyz));
}

#endif
