// Effect `textures`: an image multiplies the diffuse weight. Identity: 1.

#ifdef EFFECT_TEXTURES

layout(std430, binding = MINIRT_BINDING_UVS) readonly buffer UvBuffer { vec2 uvs[]; };  // 3 a triangle

vec3 diffuseTexture(uint image, uint corners, vec2 b) {
    if (image == MINIRT_NONE || corners == MINIRT_NONE) return vec3(1.0);
    vec2 uv = (1.0 - b.x - b.y) * uvs[corners * 3u] + b.x * uvs[corners * 3u + 1u] + b.y * uvs[corners * 3u + 2u];
    return sampleImage(image, uv);
}

#else

vec3 diffuseTexture(uint image, uint corners, vec2 b) { return vec3(1.0); }

#endif
