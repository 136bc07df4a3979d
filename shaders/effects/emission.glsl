// Effect `emission`: surfaces that shine by themselves. Identity: none.

#ifdef EFFECT_EMISSION
vec3 emission(minirt_material material) { return material.emission.rgb; }
#else
vec3 emission(minirt_material material) { return vec3(0.0); }
#endif
