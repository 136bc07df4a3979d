// Effects `reflection`, `refraction`, `fresnel`, `thin`: the rays that go on from a smooth surface. Identity: none.

/// Up to two rays. A weight of zero means that the ray does not exist.
struct Scatter {
    vec3 reflectWeight;
    vec3 reflected;
    vec3 refractWeight;
    vec3 refracted;
};

#ifdef EFFECT_FRESNEL
bool splitsByFresnel(minirt_material material) { return (material.options.x & MINIRT_MATERIAL_FRESNEL) != 0u; }
float fresnelShare(minirt_material material, Interface boundary) { return boundary.reflectance; }
#else
bool splitsByFresnel(minirt_material material) { return false; }
float fresnelShare(minirt_material material, Interface boundary) { return 0.0; }
#endif

#ifdef EFFECT_THIN
bool isThin(minirt_material material) { return (material.options.x & MINIRT_MATERIAL_THIN) != 0u; }
/// Both sides of a sheet, with all the light that goes to and fro between them.
float sheetReflectance(minirt_material material, float reflectance) {
    return isThin(material) ? 2.0 * reflectance / (1.0 + reflectance) : reflectance;
}
#else
bool isThin(minirt_material material) { return false; }
float sheetReflectance(minirt_material material, float reflectance) { return reflectance; }
#endif

#if defined(EFFECT_REFLECTION) || defined(EFFECT_REFRACTION)

/// `d` arrives at a surface with unit normals `ng` and `n`, both on the side that d comes from; `eta` is the index of refraction behind it over
/// the one in front.
Scatter scatter(minirt_material material, vec3 d, vec3 ng, vec3 n, float eta) {
    Scatter result = Scatter(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    Interface boundary = meetInterface(d, n, eta);
    float share = sheetReflectance(material, fresnelShare(material, boundary));
#ifdef EFFECT_REFRACTION
    bool transmits = maxComponent(material.transmit.rgb) > 0.0;
    bool total = boundary.totalReflection && !isThin(material);
    if (splitsByFresnel(material)) {
        result.reflectWeight = material.reflect.rgb * share;
        result.refractWeight = material.transmit.rgb * (1.0 - share);
    } else {
        // Without Fresnel, total reflection sends everything to the mirror ray.
        result.reflectWeight = transmits && total ? vec3(1.0) : material.reflect.rgb;
        result.refractWeight = total ? vec3(0.0) : material.transmit.rgb;
    }
    result.refracted = isThin(material) ? d : keepOnSide(boundary.refracted, -ng);
#else
    result.reflectWeight = material.reflect.rgb * (splitsByFresnel(material) ? share : 1.0);
#endif
    result.reflected = keepOnSide(boundary.reflected, ng);
    return result;
}

#else

Scatter scatter(minirt_material material, vec3 d, vec3 ng, vec3 n, float eta) {
    return Scatter(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

#endif
