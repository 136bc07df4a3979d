// Effect `alpha`: surfaces with holes, and surfaces that some rays meet and others do not. Identity: every ray meets what is there.

#ifdef EFFECT_ALPHA

/// Whether a ray that reaches a triangle at barycentrics `b` passes through it. Where alpha is a share, a hash of ray and triangle draws the lot: as
/// good as a random number for random rays, and the same however paths are scheduled.
bool passesAlpha(vec4 row0, vec4 row2, vec2 b, vec3 origin, vec3 direction) {
    minirt_material material = fetchMaterial(floatBitsToUint(row0.w) & ~MINIRT_PRIMITIVE_SPHERE);
    uint corners = floatBitsToUint(row2.w);
    uint flags = material.options.x & (MINIRT_MATERIAL_ALPHA_MASK | MINIRT_MATERIAL_ALPHA_BLEND);
    if (flags == 0u) return false;
    float alpha = material.transmit.w;
    if (material.options.y != MINIRT_NONE && corners != MINIRT_NONE) alpha *= sampleRgba(material.options.y, surfaceUv(corners, b)).a;
    // By its place, as a triangle that was split lies in several slots; faces in one place with one material draw the same. A round of the hash for
    // each part: rays to one point have bits in common.
    uvec4 bits = hashBits(uvec4(floatBitsToUint(row0.xyz) + floatBitsToUint(row2.xyz) * 0x85ebca6bu, floatBitsToUint(row0.w)));
    bits = hashBits(bits ^ uvec4(floatBitsToUint(origin), 0u));
    bits = hashBits(bits ^ uvec4(floatBitsToUint(direction), 0u));
    float lot = unitReal(bits.x);
    return alpha < (flags == MINIRT_MATERIAL_ALPHA_MASK ? material.finish.w : lot) || alpha <= 0.0;
}

#else

bool passesAlpha(vec4 row0, vec4 row2, vec2 b, vec3 origin, vec3 direction) { return false; }

#endif
