// Effects `point_lights`, `directional_lights`, `highlights`. Identity: no light at all.

struct LightSample {
    vec3 toLight;     // unit
    float distance;   // end of the shadow ray
    vec3 irradiance;  // on a plane that faces the light
};

#if defined(EFFECT_POINT_LIGHTS) || defined(EFFECT_DIRECTIONAL_LIGHTS)

layout(binding = MINIRT_BINDING_LIGHTS) uniform usamplerBuffer lightRows;

minirt_light fetchLight(uint index) {
    int row = int(index) * MINIRT_LIGHT_ROWS;
    return minirt_light(uintBitsToFloat(texelFetch(lightRows, row)), uintBitsToFloat(texelFetch(lightRows, row + 1)),
                        uintBitsToFloat(texelFetch(lightRows, row + 2)), texelFetch(lightRows, row + 3));
}

uint lightCount() { return scene.counts.x; }

#ifdef EFFECT_POINT_LIGHTS
LightSample pointLight(minirt_light light, vec3 p) {
    vec3 away = light.position.xyz - p;
    float distance = max(length(away), 1e-20);
    float falloff = (light.options.x & MINIRT_LIGHT_INVERSE_SQUARE) != 0u ? distance * distance : 1.0;
    return LightSample(away / distance, distance, light.intensity.rgb / falloff);
}
#endif

LightSample sampleLight(uint index, vec3 p) {
    minirt_light light = fetchLight(index);
#if defined(EFFECT_POINT_LIGHTS) && defined(EFFECT_DIRECTIONAL_LIGHTS)
    if ((light.options.x & MINIRT_LIGHT_DIRECTIONAL) == 0u) return pointLight(light, p);
#elif defined(EFFECT_POINT_LIGHTS)
    return pointLight(light, p);
#endif
#ifdef EFFECT_DIRECTIONAL_LIGHTS
    return LightSample(light.position.xyz, MINIRT_RAY_END, light.intensity.rgb);
#endif
}

#else

uint lightCount() { return 0u; }
LightSample sampleLight(uint index, vec3 p) { return LightSample(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0)); }

#endif

#ifdef EFFECT_HIGHLIGHTS

/// Phong's highlight: weight * max(0, r.v)^shininess. `wo` points to the viewer, `wi` to the light.
vec3 highlight(minirt_material material, vec3 n, vec3 wi, vec3 wo) {
    float cosine = max(dot(2.0 * dot(n, wi) * n - wi, wo), 0.0);
    return material.specular.rgb * (cosine > 0.0 ? pow(cosine, material.diffuse.w) : 0.0);
}

#else

vec3 highlight(minirt_material material, vec3 n, vec3 wi, vec3 wo) { return vec3(0.0); }

#endif
