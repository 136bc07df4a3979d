// Effect `textures`: an image multiplies the diffuse weight. Identity: 1.

#ifdef EFFECT_TEXTURES

layout(binding = MINIRT_BINDING_UVS) uniform usamplerBuffer uvRows;  // 2 a triangle: three pairs

vec3 diffuseTexture(uint image, uint corners, vec2 b) {
    if (image == MINIRT_NONE || corners == MINIRT_NONE) return vec3(1.0);
    vec4 first = uintBitsToFloat(texelFetch(uvRows, int(corners * 2u)));
    vec4 second = uintBitsToFloat(texelFetch(uvRows, int(corners * 2u + 1u)));
    return sampleImage(image, (1.0 - b.x - b.y) * first.xy + b.x * first.zw + b.y * second.xy);
}

#else

vec3 diffuseTexture(uint image, uint corners, vec2 b) { return vec3(1.0); }

#endif
