// Effects `emission`, `emission_maps`: surfaces that shine by themselves, to their front unless they say both. Identities: none; evenly.

#ifdef EFFECT_EMISSION_MAPS
vec3 emissionTexture(minirt_material material, vec2 uv) {
    return material.images.z == MINIRT_NONE ? vec3(1.0) : sampleImage(material.images.z, uv);
}
#else
vec3 emissionTexture(minirt_material material, vec2 uv) { return vec3(1.0); }
#endif

#ifdef EFFECT_EMISSION

/// Radiance; `front`: seen from the side of the geometric normal.
vec3 emission(minirt_material material, bool front, vec2 uv) {
    bool shines = front || (material.options.x & MINIRT_MATERIAL_SHINES_BOTH_WAYS) != 0u;
    return shines ? material.emission.rgb * emissionTexture(material, uv) : vec3(0.0);
}

#else

vec3 emission(minirt_material material, bool front, vec2 uv) { return vec3(0.0); }

#endif
