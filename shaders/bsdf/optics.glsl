// Light at a smooth interface. GLSL and C++ (tests/shader_source.hpp).

/// What happens to a ray of direction `d` that meets the interface with normal `n` (unit, against d: dot(d, n) <= 0).
struct Interface {
    vec3 reflected;  // unit
    vec3 refracted;  // unit; equal to d bit for bit when eta is 1; undefined when totalReflection
    real reflectance;  // exact unpolarised Fresnel, 1 under total reflection
    bool totalReflection;
};

/// `eta`: index of refraction behind the interface over the one in front.
/// sin^2 comes from the cross product, which stays exact at grazing angles where 1 - cos^2 cancels.
Interface meetInterface(vec3 d, vec3 n, real eta) {
    Interface result;
    real cosI = max(-dot(d, n), real(0));
    vec3 across = cross(d, n);
    real sin2I = min(dot(across, across), real(1));
    real sin2T = sin2I / (eta * eta);
    result.reflected = normalize(d + n * (real(2) * cosI));
    result.totalReflection = sin2T >= real(1);
    real cosT = sqrt(max(real(1) - sin2T, real(0)));
    result.refracted = normalize((d + n * cosI) / eta - n * cosT);
    real parallel = (eta * cosI - cosT) / (eta * cosI + cosT);
    real perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
    result.reflectance = result.totalReflection ? real(1) : real(0.5) * (parallel * parallel + perpendicular * perpendicular);
    if (eta == real(1)) {
        result.refracted = d;
        result.reflectance = real(0);
        result.totalReflection = false;
    }
    return result;
}

/// `w` pushed to the side of the unit normal `side` where a shading normal sent it to the other side, or within rounding of it; else
/// w bit for bit.
vec3 keepOnSide(vec3 w, vec3 side) {
    real height = dot(w, side);
    return height > errorGamma(3) ? w : normalize(w + side * (real(1e-4) - height));
}
