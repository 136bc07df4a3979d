// Lever `fresnel`. Default: the exact reflectance of bsdf/optics.glsl. Else Schlick's (1994), by the cosine on the side of the ray, or none: all light
// goes through. Total reflection is Snell's law and stays.

#if defined(FRESNEL_NONE) || defined(FRESNEL_SCHLICK)

Interface meetInterfaceCheaply(vec3 d, vec3 n, float eta) {
    Interface result = meetInterface(d, n, eta);
#ifdef FRESNEL_SCHLICK
    float bend = (eta - 1.0) / (eta + 1.0);
    float rest = 1.0 - clamp(-dot(d, n), 0.0, 1.0);
    float share = bend * bend + (1.0 - bend * bend) * rest * rest * rest * rest * rest;
    if (eta == 1.0) share = 0.0;
#else
    float share = 0.0;
#endif
    result.reflectance = result.totalReflection ? 1.0 : share;
    return result;
}

#define meetInterface meetInterfaceCheaply

#endif
