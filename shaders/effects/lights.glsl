// Effects `point_lights`, `directional_lights`, `spot_lights`, `highlights`. Identity: no light at all.

struct LightSample {
    vec3 toLight;     // unit
    float distance;   // end of the shadow ray
    vec3 irradiance;  // on a plane that faces the light
};

#if defined(EFFECT_POINT_LIGHTS) || defined(EFFECT_DIRECTIONAL_LIGHTS) || defined(EFFECT_SPOT_LIGHTS)

layout(binding = MINIRT_BINDING_LIGHTS) uniform usamplerBuffer lightRows;

minirt_light fetchLight(uint index) {
    int row = int(index) * MINIRT_LIGHT_ROWS;
    return minirt_light(uintBitsToFloat(texelFetch(lightRows, row)), uintBitsToFloat(texelFetch(lightRows, row + 1)),
                        uintBitsToFloat(texelFetch(lightRows, row + 2)), texelFetch(lightRows, row + 3));
}

uint lightCount() { return scene.counts.x; }

#ifdef EFFECT_SPOT_LIGHTS
/// The share of a spot's intensity in a unit direction; 1 of other lights. The edge is as KHR_lights_punctual has it.
float spotShare(minirt_light light, vec3 toLight) {
    float outer = light.position.w;
    float inside = clamp((-dot(light.axis.xyz, toLight) - outer) / max(light.intensity.w - outer, 1e-6), 0.0, 1.0);
    return (light.options.x & MINIRT_LIGHT_SPOT) != 0u ? inside * inside : 1.0;
}
#else
float spotShare(minirt_light light, vec3 toLight) { return 1.0; }
#endif

LightSample positionalLight(minirt_light light, vec3 p) {
    vec3 away = light.position.xyz - p;
    float distance = max(length(away), 1e-20);
    float falloff = (light.options.x & MINIRT_LIGHT_INVERSE_SQUARE) != 0u ? distance * distance : 1.0;
    vec3 toLight = away / distance;
    return LightSample(toLight, distance, light.intensity.rgb / falloff * spotShare(light, toLight));
}

#if defined(EFFECT_POINT_LIGHTS) || defined(EFFECT_SPOT_LIGHTS)
const bool LIGHTS_HAVE_PLACES = true;
#else
const bool LIGHTS_HAVE_PLACES = false;
#endif

#ifdef EFFECT_DIRECTIONAL_LIGHTS
bool isDirectional(minirt_light light) { return (light.options.x & MINIRT_LIGHT_DIRECTIONAL) != 0u || !LIGHTS_HAVE_PLACES; }
#else
bool isDirectional(minirt_light light) { return false; }
#endif

LightSample sampleLight(uint index, vec3 p) {
    minirt_light light = fetchLight(index);
    if (isDirectional(light)) return LightSample(light.position.xyz, MINIRT_RAY_END, light.intensity.rgb);
    return positionalLight(light, p);
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
