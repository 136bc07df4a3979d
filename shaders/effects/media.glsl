// Effects `absorption`, `inscatter`. Identities: clear media.

#if defined(EFFECT_NESTING) || defined(EFFECT_ABSORPTION) || defined(EFFECT_INSCATTER) || defined(EFFECT_DISPERSION)

layout(binding = MINIRT_BINDING_MEDIA) uniform usamplerBuffer mediumRows;

vec4 mediumRow(uint medium, int k) { return uintBitsToFloat(texelFetch(mediumRows, int(medium) * MINIRT_MEDIUM_ROWS + k)); }

#endif

#ifdef EFFECT_ABSORPTION

/// The share of light that is left after `distance` metres of a medium.
vec3 transmittance(uint medium, float distance) {
    vec3 depth = mediumRow(medium, 0).rgb * distance;
    return medium == 0u ? vec3(1.0) : vec3(beerLambert(depth.r), beerLambert(depth.g), beerLambert(depth.b));
}

#else

vec3 transmittance(uint medium, float distance) { return vec3(1.0); }

#endif

#ifdef EFFECT_INSCATTER

const bool MEDIA_SHINE = true;

/// What a medium adds of its own over `distance` metres.
vec3 inscattered(uint medium, float distance) {
    vec4 absorption = mediumRow(medium, 0);
    vec3 depth = absorption.rgb * distance;
    float w = medium == 0u ? 0.0 : absorption.w;
    return vec3(inscatteredShare(depth.r, w), inscatteredShare(depth.g, w), inscatteredShare(depth.b, w));
}

#else

const bool MEDIA_SHINE = false;

vec3 inscattered(uint medium, float distance) { return vec3(0.0); }

#endif
