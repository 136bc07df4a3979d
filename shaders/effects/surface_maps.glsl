// Effects `surface_maps`, `normal_maps`: images of roughness and metallic, and of normals. Identities: the material's numbers; the normal of
// the geometry.

#ifdef EFFECT_SURFACE_MAPS

/// Roughness and metallic.
vec2 surfaceFinish(minirt_material material, vec2 uv) {
    vec2 factors = vec2(material.finish.x, material.base.w);
    return material.images.x == MINIRT_NONE ? factors : factors * sampleImage(material.images.x, uv).gb;
}

#else

vec2 surfaceFinish(minirt_material material, vec2 uv) { return vec2(material.finish.x, material.base.w); }

#endif

#ifdef EFFECT_NORMAL_MAPS

/// The shading normal `n` tilted by the material's image of normals, whose red axis follows u and whose green axis goes up the image.
vec3 mappedNormal(minirt_material material, uint corners, vec2 uv, vec3 v0, vec3 v1, vec3 v2, vec3 n) {
    if (material.images.y == MINIRT_NONE || corners == MINIRT_NONE) return n;
    CornerUvs c = cornerUvs(corners);
    vec2 d1 = c.uv1 - c.uv0;
    vec2 d2 = c.uv2 - c.uv0;
    float area = d1.x * d2.y - d1.y * d2.x;
    vec3 along = ((v1 - v0) * d2.y - (v2 - v0) * d1.y) * (area < 0.0 ? -1.0 : 1.0);  // of growing u
    vec3 t = along - n * dot(n, along);
    vec3 tilt = sampleImage(material.images.y, uv) * 2.0 - 1.0;
    vec3 b = cross(n, t) * (area < 0.0 ? 1.0 : -1.0);  // of falling v: up the image
    float size = length(t);
    vec3 tilted = t * (tilt.x * material.finish.z / size) + b * (tilt.y * material.finish.z / size) + n * tilt.z;
    bool good = area != 0.0 && size > 0.0 && dot(tilted, tilted) > 0.0;
    return good ? normalize(tilted) : n;
}

#else

vec3 mappedNormal(minirt_material material, uint corners, vec2 uv, vec3 v0, vec3 v1, vec3 v2, vec3 n) { return n; }

#endif
