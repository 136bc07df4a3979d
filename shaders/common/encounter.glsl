// A surface as the ray that hits it sees it.

struct Encounter {
    Surface surface;
    minirt_material material;
    vec3 ng;  // geometric and shading normal on the side of the ray
    vec3 n;
    bool entering;
    Boundary boundary;
    float eta;  // index of refraction behind the surface over the one in front
};

Encounter encounterAt(vec3 origin, vec3 direction, uint slot, float t, VolumeList volumes, uint channel) {
    Encounter e;
    e.surface = surfaceAt(origin, direction, slot, t);
    e.material = fetchMaterial(e.surface.material);
    e.entering = dot(direction, e.surface.ng) < 0.0;
    e.ng = e.entering ? e.surface.ng : -e.surface.ng;
    e.n = e.entering ? e.surface.n : -e.surface.n;
    e.boundary = boundaryAt(volumes, bodyOf(slot), e.entering);
    e.eta = iorRatio(e.boundary, e.material, e.entering, channel);
    return e;
}

/// Where rays that leave the surface start, in front of it and behind.
vec3 aboveSurface(Encounter e) { return offsetRayOrigin(e.surface.p, e.surface.pError, e.ng, e.ng); }
vec3 belowSurface(Encounter e) { return offsetRayOrigin(e.surface.p, e.surface.pError, e.ng, -e.ng); }

/// The ray to a camera at `p` from outside of all volumes, which finds out what volumes that is in. Its direction is that of no symmetry, so that
/// it meets few edges of what people model.
Traversal rayToCamera(vec3 p) {
    const vec3 outwards = vec3(0.3713907, 0.7427814, 0.5570860);
    float distance = 2.0 * length(max(abs(scene.boundsMin.xyz - p), abs(scene.boundsMax.xyz - p)));
    return beginTraversal(p + distance * outwards, -outwards, distance, false);
}

/// The same behind the surface that it has met.
Traversal passToCamera(Traversal ray, vec3 p, Encounter e) {
    vec3 origin = belowSurface(e);
    return beginTraversal(origin, ray.direction, max(dot(p - origin, ray.direction), 0.0), false);
}
