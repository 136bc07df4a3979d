// Effect `textures`: an image multiplies the diffuse weight. Identity: 1. Texture coordinates are here for all effects that read images.

#if defined(EFFECT_TEXTURES) || defined(EFFECT_ALPHA) || defined(EFFECT_NORMAL_MAPS) || defined(EFFECT_SURFACE_MAPS) || defined(EFFECT_EMISSION_MAPS)

layout(binding = MINIRT_BINDING_UVS) uniform usamplerBuffer uvRows;  // 2 a triangle: three pairs

/// At barycentrics `b` of a triangle that has corners.
vec2 textureCoordinates(uint corners, vec2 b) {
    vec4 first = uintBitsToFloat(texelFetch(uvRows, int(corners * 2u)));
    vec4 second = uintBitsToFloat(texelFetch(uvRows, int(corners * 2u + 1u)));
    return (1.0 - b.x - b.y) * first.xy + b.x * first.zw + b.y * second.xy;
}

#endif

#ifdef EFFECT_TEXTURES

vec3 diffuseTexture(uint image, uint corners, vec2 b) {
    if (image == MINIRT_NONE || corners == MINIRT_NONE) return vec3(1.0);
    return sampleImage(image, textureCoordinates(corners, b));
}

#else

vec3 diffuseTexture(uint image, uint corners, vec2 b) { return vec3(1.0); }

#endif
