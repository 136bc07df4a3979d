// From a point to a light: next-event estimation, and how it shares the work with rays that find light by following surfaces.

/// Random numbers of a path at one of its vertices, as pairs of Sobol's points. Vertex 0 is the camera.
const uint PAIR_PIXEL = 0u;
const uint PAIR_LENS = 1u;
const uint PAIR_EMITTER = 0u;
const uint PAIR_CELL = 1u;
const uint PAIR_LIGHT_POINT = 2u;
const uint PAIR_LOBE = 3u;
const uint PAIR_DIRECTION = 4u;
const uint PAIR_SURVIVAL = 5u;  // and the channel of divided light

/// What tells a pixel's random numbers from those of others and of other seeds.
uvec2 keyOf(uvec2 pixel) { return uvec2(pixel.x ^ scatterBits(frame.blocks.z), pixel.y); }

uvec2 drawBits(uvec2 pixel, uint vertex, uint pair) { return sobolPairBits(keyOf(pixel), frame.sampling.x, vertex, pair); }

vec2 draw(uvec2 pixel, uint vertex, uint pair) {
    uvec2 bits = drawBits(pixel, vertex, pair);
    return vec2(unitReal(bits.x), unitReal(bits.y));
}

/// A way from p to one of all lights.
LightRay pickLight(vec3 p, uvec2 pixel, uint vertex) {
    uvec2 picked = pickEmitter(drawBits(pixel, vertex, PAIR_EMITTER));
    float probability = uintBitsToFloat(picked.y);
    uint index = picked.x & MINIRT_EMITTER_INDEX;
    if (probability <= 0.0) return noLightRay();
    if ((picked.x & MINIRT_EMITTER_ENVIRONMENT) != 0u) {
        vec3 wi = pickDirection(drawBits(pixel, vertex, PAIR_CELL), draw(pixel, vertex, PAIR_LIGHT_POINT));
        return LightRay(wi, MINIRT_RAY_END, backgroundRadiance(wi), environmentPdf(wi), true);
    }
    if ((picked.x & MINIRT_EMITTER_LIGHT) == 0u) return towardsPrimitive(index, p, draw(pixel, vertex, PAIR_LIGHT_POINT));
    LightSample light = sampleLight(index, p);
    return LightRay(light.toLight, light.distance, light.irradiance, probability, false);
}

uint lightSampling() { return frame.sampling.y >> MINIRT_FRAME_LIGHTS_SHIFT; }

/// Weight of light that was picked with density `pdf` where following the surface would find it with density `other`.
float pickedWeight(float pdf, float other) {
    uint method = lightSampling();
    float heuristic = method == MINIRT_LIGHT_SAMPLING_MIS ? powerWeight(pdf, other) : balanceWeight(pdf, other);
    return method == MINIRT_LIGHT_SAMPLING_LIGHTS ? 1.0 : method == MINIRT_LIGHT_SAMPLING_SURFACES ? 0.0 : heuristic;
}

/// Weight of light that following a surface with density `pdf` (0: there was no other way) has found, where picking has density `other`.
float foundWeight(float pdf, float other) {
    if (pdf <= 0.0 || other <= 0.0) return 1.0;
    uint method = lightSampling();
    float heuristic = method == MINIRT_LIGHT_SAMPLING_MIS ? powerWeight(pdf, other) : balanceWeight(pdf, other);
    return method == MINIRT_LIGHT_SAMPLING_LIGHTS ? 0.0 : method == MINIRT_LIGHT_SAMPLING_SURFACES ? 1.0 : heuristic;
}
