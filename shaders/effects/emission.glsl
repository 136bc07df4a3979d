// Effect `emission`: surfaces that shine by themselves, to the side that their geometric normal points to or to both. Identity: none.

#ifdef EFFECT_EMISSION
vec3 emission(minirt_material material, bool front) {
    bool shines = front || (material.options.x & MINIRT_MATERIAL_SHINES_BOTH_WAYS) != 0u;
    return shines ? material.emission.rgb : vec3(0.0);
}
#else
vec3 emission(minirt_material material, bool front) { return vec3(0.0); }
#endif
