// Effect `microfacets`: metals, and coats over what is opaque, for the path tracers. Identity: Lambert's surfaces only.
//
// Directions as in bsdf/microfacet.glsl.

/// The opaque part of a surface.
struct BaseLobe {
    vec3 albedo;  // of a surface without coat
    MetallicRoughness coat;
    bool coated;
};

vec3 evalLambert(vec3 albedo, vec3 wi) { return albedo * cosineHemispherePdf(wi.z); }

#ifdef EFFECT_MICROFACETS

/// `finish`: roughness and metallic at the point.
BaseLobe baseLobe(minirt_material material, vec3 albedo, vec2 finish) {
    bool physical = (material.options.x & MINIRT_MATERIAL_PHYSICAL) != 0u;
    float bend = (material.specular.w - 1.0) / (material.specular.w + 1.0);
    MetallicRoughness coat;
    coat.baseColor = albedo;
    coat.metallic = finish.y;
    coat.alpha = ggxAlpha(finish.x);
    coat.dielectricF0 = bend * bend;
    return BaseLobe(albedo, coat, physical && (bend != 0.0 || finish.y > 0.0));
}

/// What a metal without roughness mirrors at the cosine c; 0 where a surface is none, and is all of the base.
vec3 mirrorOf(BaseLobe lobe, float roughness, float c) {
    vec3 f0 = metallicRoughnessF0(lobe.coat);
    bool mirror = lobe.coated && lobe.coat.metallic >= 1.0 && roughness <= 0.0;
    return mirror ? f0 + (1.0 - f0) * schlickRise(c) : vec3(0.0);
}

/// f cos(wi).
vec3 evalBase(BaseLobe lobe, vec3 wo, vec3 wi) {
    vec3 coated = evalMetallicRoughness(lobe.coat, wo, wi) * max(wi.z, 0.0);
    return lobe.coated ? coated : evalLambert(lobe.albedo, wi);
}

float pdfBase(BaseLobe lobe, vec3 wo, vec3 wi) {
    float coated = pdfMetallicRoughness(lobe.coat, wo, wi);
    return lobe.coated ? coated : cosineHemispherePdf(wi.z);
}

/// A direction; `part` in [0,1) chooses among the parts of the surface. Zero where light ends under the surface.
vec3 sampleBase(BaseLobe lobe, vec3 wo, vec2 u, float part) {
    BsdfSample coated = sampleMetallicRoughness(lobe.coat, wo, u, part);
    return !lobe.coated ? cosineHemisphere(u) : coated.pdf > 0.0 ? coated.wi : vec3(0.0);
}

/// About how much light comes back.
float baseImportance(BaseLobe lobe) { return lobe.coated ? 1.0 : importance(lobe.albedo); }

#else

BaseLobe baseLobe(minirt_material material, vec3 albedo, vec2 finish) {
    return BaseLobe(albedo, MetallicRoughness(vec3(0.0), 0.0, 1.0, 0.0), false);
}
vec3 mirrorOf(BaseLobe lobe, float roughness, float c) { return vec3(0.0); }
vec3 evalBase(BaseLobe lobe, vec3 wo, vec3 wi) { return evalLambert(lobe.albedo, wi); }
float pdfBase(BaseLobe lobe, vec3 wo, vec3 wi) { return cosineHemispherePdf(wi.z); }
vec3 sampleBase(BaseLobe lobe, vec3 wo, vec2 u, float part) { return cosineHemisphere(u); }
float baseImportance(BaseLobe lobe) { return importance(lobe.albedo); }

#endif
