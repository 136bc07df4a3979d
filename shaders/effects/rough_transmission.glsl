// Effect `rough_transmission`: frosted glass, for the path tracers. Identity: glass is smooth.

#ifdef EFFECT_ROUGH_TRANSMISSION

/// The share of a surface that is frosted glass.
float frosted(minirt_material material, float roughness) {
    bool physical = (material.options.x & MINIRT_MATERIAL_PHYSICAL) != 0u;
    return physical && roughness > 0.0 && !isThin(material) ? material.finish.y : 0.0;
}

/// f |cos(wi)|. Radiance counts as if it were outside of the denser medium, as everywhere in the kernels: no factor 1 / eta^2.
vec3 evalFrosted(vec3 tint, float alpha, float eta, vec3 wo, vec3 wi) {
    float f = evalDielectric(alpha, eta, wo, wi) * abs(wi.z);
    return wi.z > 0.0 ? vec3(f) : tint * (f * eta * eta);
}

float pdfFrosted(float alpha, float eta, vec3 wo, vec3 wi) { return pdfDielectric(alpha, eta, wo, wi); }

BsdfSample sampleFrosted(float alpha, float eta, vec3 wo, vec2 u, float part) { return sampleDielectric(alpha, eta, wo, u, part); }

#else

float frosted(minirt_material material, float roughness) { return 0.0; }
vec3 evalFrosted(vec3 tint, float alpha, float eta, vec3 wo, vec3 wi) { return vec3(0.0); }
float pdfFrosted(float alpha, float eta, vec3 wo, vec3 wi) { return 0.0; }
BsdfSample sampleFrosted(float alpha, float eta, vec3 wo, vec2 u, float part) { return noSample(); }

#endif
