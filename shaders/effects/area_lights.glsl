// Effect `area_lights`: points of surfaces that shine are picked. Identity: they are found by chance.

/// A way to a light.
struct LightRay {
    vec3 wi;
    float distance;
    vec3 light;  // radiance; of a light without size the irradiance on a plane that faces it
    float pdf;   // with which it was picked, per steradian; of a light without size the probability; 0: there is none
    bool sized;
};

LightRay noLightRay() { return LightRay(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0, true); }

#ifdef EFFECT_AREA_LIGHTS

/// Density over area, 1/m^2, with which points of a primitive are picked.
float emitterDensity(uint slot) { return uintBitsToFloat(texelFetch(materialRows, int(materialOf(slot)) * MINIRT_MATERIAL_ROWS + 4)).w; }

/// The same over the area of a sphere, which is picked as a whole.
float sphereShare(uint slot, float radius) { return emitterDensity(slot) * 4.0 * PI * radius * radius; }

/// Density per steradian at `from` with which a path picks the point p of a primitive, seen along `direction`.
float emitterPdf(uint slot, vec3 from, vec3 p, vec3 ng, vec3 direction) {
    vec4 row0 = primitiveRow(slot, 0u);
    float radius = primitiveRow(slot, 1u).x;
    float triangle = directionPdf(emitterDensity(slot), length(p - from), abs(dot(ng, direction)));
    return isSphere(row0) ? sphereShare(slot, radius) * sphereLightPdf(from, row0.xyz, radius) : triangle;
}

/// How far a ray may go without meeting the light itself: `error` bounds that of a point on it across its surface, which a ray that meets it under
/// `cosine` feels that much more along its way.
float shortOf(float distance, float error, float cosine) {
    return max(distance - (2.0 * error + 8.0 * MACHINE_EPSILON * distance) / max(cosine, 1e-6), 0.0);
}

/// A way from p to a shining sphere.
LightRay towardsSphere(uint slot, vec3 p, vec3 center, float radius, vec2 u) {
    SphereLightSample light = sampleSphereLight(p, center, radius, u);
    bool outside = length(center - p) > radius;
    vec3 shine = emission(fetchMaterial(materialOf(slot)), outside, vec2(0.0));
    float error = errorGamma(8) * (maxComponent(abs(center)) + radius + light.distance);
    float cosine = abs(dot(p + light.distance * light.wi - center, light.wi)) / radius;
    return LightRay(light.wi, shortOf(light.distance, error, cosine), shine, sphereShare(slot, radius) * light.pdf, true);
}

/// A way from p to a shining primitive. It ends before the primitive itself.
LightRay towardsPrimitive(uint slot, vec3 p, vec2 u) {
    vec4 row0 = primitiveRow(slot, 0u);
    vec4 row1 = primitiveRow(slot, 1u);
    vec4 row2 = primitiveRow(slot, 2u);
    if (isSphere(row0)) return towardsSphere(slot, p, row0.xyz, row1.x, u);
    TriangleHit hit;
    vec2 b = uniformTriangle(u);
    hit.b1 = b.x;
    hit.b2 = b.y;
    SurfacePoint point = trianglePoint(hit, row0.xyz, row1.xyz, row2.xyz);
    vec3 away = point.p - p;
    float distance = length(away);
    vec3 wi = away / max(distance, 1e-30);
    float cosine = -dot(point.ng, wi);
    float end = shortOf(distance, dot(abs(point.ng), point.pError), abs(cosine));
    vec3 shine = emission(fetchMaterial(materialOf(slot)), cosine > 0.0, surfaceUv(floatBitsToUint(row2.w), b));
    return LightRay(wi, end, shine, directionPdf(emitterDensity(slot), distance, abs(cosine)), true);
}

#else

float emitterPdf(uint slot, vec3 from, vec3 p, vec3 ng, vec3 direction) { return 0.0; }
LightRay towardsPrimitive(uint slot, vec3 p, vec2 u) { return noLightRay(); }

#endif
