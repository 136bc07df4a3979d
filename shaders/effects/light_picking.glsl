// All that shines in one table, of which a path picks an entry by its power: effects `point_lights`, `directional_lights`, `spot_lights`, `area_lights`,
// `environment_light`. Identity: nothing is picked.

/// An entry of a table with `count` of them, all alike.
uint entryOf(uint bits, uint count) {
    uint high;
    uint low;
    umulExtended(bits, count, high, low);
    return high;
}

#if defined(EFFECT_POINT_LIGHTS) || defined(EFFECT_DIRECTIONAL_LIGHTS) || defined(EFFECT_SPOT_LIGHTS) || defined(EFFECT_AREA_LIGHTS) || \
    defined(EFFECT_ENVIRONMENT_LIGHT)

layout(binding = MINIRT_BINDING_EMITTERS) uniform usamplerBuffer emitterRows;

/// x: a MINIRT_EMITTER_ with its number; y: bits of its probability, 0: there is none.
uvec2 pickEmitter(uvec2 bits) {
    if (scene.counts.w == 0u) return uvec2(0u);
    uint entry = entryOf(bits.x, scene.counts.w);
    uvec4 row = texelFetch(emitterRows, int(entry));
    if (bits.y >= row.z) row = texelFetch(emitterRows, int(row.y));
    return row.xw;
}

#else

uvec2 pickEmitter(uvec2 bits) { return uvec2(0u); }

#endif
