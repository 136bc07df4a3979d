// Effects `reflection`, `refraction`, `fresnel`: the rays that go on from a smooth surface. Identity: none.

/// Up to two rays. A weight of zero means that the ray does not exist.
struct Scatter {
    vec3 reflectWeight;
    vec3 reflected;
    vec3 refractWeight;
    vec3 refracted;
};

#if defined(EFFECT_REFLECTION) || defined(EFFECT_REFRACTION)

/// The share of the mirror ray: weights of the material, or exact Fresnel.
float fresnelShare(minirt_material material, Interface boundary) {
#ifdef EFFECT_FRESNEL
    return boundary.reflectance;
#else
    return 0.0;
#endif
}

bool splitsByFresnel(minirt_material material) {
#ifdef EFFECT_FRESNEL
    return (material.options.x & MINIRT_MATERIAL_FRESNEL) != 0u;
#else
    return false;
#endif
}

/// `d` arrives at a surface with unit normals `ng` and `n`, both on the side that d comes from; `entering` says which side that is.
Scatter scatter(minirt_material material, vec3 d, vec3 ng, vec3 n, bool entering) {
    Scatter result = Scatter(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
#ifdef EFFECT_REFRACTION
    bool transmits = maxComponent(material.transmit.rgb) > 0.0;
    float ior = material.specular.w;
    Interface boundary = meetInterface(d, n, entering || !transmits ? ior : 1.0 / ior);  // what is opaque mirrors alike from both sides
    if (splitsByFresnel(material)) {
        result.reflectWeight = material.reflect.rgb * fresnelShare(material, boundary);
        result.refractWeight = material.transmit.rgb * (1.0 - fresnelShare(material, boundary));
    } else {
        // Without Fresnel, total reflection sends everything to the mirror ray.
        result.reflectWeight = transmits && boundary.totalReflection ? vec3(1.0) : material.reflect.rgb;
        result.refractWeight = boundary.totalReflection ? vec3(0.0) : material.transmit.rgb;
    }
    result.refracted = keepOnSide(boundary.refracted, -ng);
#else
    Interface boundary = meetInterface(d, n, material.specular.w);
    result.reflectWeight = material.reflect.rgb * (splitsByFresnel(material) ? fresnelShare(material, boundary) : 1.0);
#endif
    result.reflected = keepOnSide(boundary.reflected, ng);
    return result;
}

#else

Scatter scatter(minirt_material material, vec3 d, vec3 ng, vec3 n, bool entering) {
    return Scatter(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

#endif
