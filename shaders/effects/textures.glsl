// Effect `textures`: an image multiplies the diffuse weight and the base colour. Identity: 1. With it, texture coordinates for all effects that
// read images by them: `alpha`, `surface_maps`, `normal_maps`, `emission_maps`; without any of these, all are zero.

#if defined(EFFECT_TEXTURES) || defined(EFFECT_ALPHA) || defined(EFFECT_SURFACE_MAPS) || defined(EFFECT_NORMAL_MAPS) || defined(EFFECT_EMISSION_MAPS)

layout(binding = MINIRT_BINDING_UVS) uniform usamplerBuffer uvRows;  // 2 a triangle: three pairs

/// Texture coordinates of a triangle's corners.
struct CornerUvs {
    vec2 uv0, uv1, uv2;
};

CornerUvs cornerUvs(uint corners) {
    vec4 first = uintBitsToFloat(texelFetch(uvRows, int(corners * 2u)));
    vec4 second = uintBitsToFloat(texelFetch(uvRows, int(corners * 2u + 1u)));
    return CornerUvs(first.xy, first.zw, second.xy);
}

/// At barycentrics `b`; zero where the primitive has none.
vec2 surfaceUv(uint corners, vec2 b) {
    if (corners == MINIRT_NONE) return vec2(0.0);
    CornerUvs c = cornerUvs(corners);
    return (1.0 - b.x - b.y) * c.uv0 + b.x * c.uv1 + b.y * c.uv2;
}

#else

vec2 surfaceUv(uint corners, vec2 b) { return vec2(0.0); }

#endif

#ifdef EFFECT_TEXTURES

vec3 diffuseTexture(uint image, uint corners, vec2 uv) {
    return image == MINIRT_NONE || corners == MINIRT_NONE ? vec3(1.0) : sampleImage(image, uv);
}

#else

vec3 diffuseTexture(uint image, uint corners, vec2 uv) { return vec3(1.0); }

#endif
