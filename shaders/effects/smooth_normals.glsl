// Effect `smooth_normals`: shading normals by barycentric interpolation. Identity: the geometric normal.

#ifdef EFFECT_SMOOTH_NORMALS

layout(binding = MINIRT_BINDING_NORMALS) uniform usamplerBuffer normalRows;  // 3 a triangle: unit vectors

vec3 cornerNormal(uint corners, uint k) { return uintBitsToFloat(texelFetch(normalRows, int(corners * 3u + k)).xyz); }

/// Unit shading normal; `lift` is where shadow rays start: the point moved out to the curved surface that the normals describe,
/// which hides the facets' own terminator (Hanika, Ray Tracing Gems II ch. 4).
vec3 shadingNormal(uint corners, vec3 v0, vec3 v1, vec3 v2, vec2 b, vec3 p, vec3 ng, out vec3 lift) {
    lift = vec3(0.0);
    if (corners == MINIRT_NONE) return ng;
    float b0 = 1.0 - b.x - b.y;
    vec3 n0 = cornerNormal(corners, 0u);
    vec3 n1 = cornerNormal(corners, 1u);
    vec3 n2 = cornerNormal(corners, 2u);
    lift = -(b0 * min(0.0, dot(p - v0, n0)) * n0 + b.x * min(0.0, dot(p - v1, n1)) * n1 + b.y * min(0.0, dot(p - v2, n2)) * n2);
    vec3 n = b0 * n0 + b.x * n1 + b.y * n2;
    float size = length(n);
    return size > 1e-6 ? n / size : ng;
}

#else

vec3 shadingNormal(uint corners, vec3 v0, vec3 v1, vec3 v2, vec2 b, vec3 p, vec3 ng, out vec3 lift) {
    lift = vec3(0.0);
    return ng;
}

#endif
