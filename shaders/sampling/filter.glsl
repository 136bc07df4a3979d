// Pixel filters by importance: a sample counts fully, and lies where the filter weighs most. GLSL and C++ (tests/shader_source.hpp);
// MINIRT_FILTER_ is the layout's.

/// Distributed as the tent of half width 1 around 0, u in [0,1).
real tentOffset(real u) { return u < real(0.5) ? sqrt(real(2) * u) - real(1) : real(1) - sqrt(real(2) - real(2) * u); }

/// Distributed as a Gaussian with a standard deviation of half a pixel, cut off three of them from the middle.
vec2 gaussianOffset(vec2 u) {
    const real within = real(0.98889100346175773);  // 1 - exp(-9 / 2)
    real radius = real(0.5) * sqrt(max(real(-2) * log(real(1) - u.x * within), real(0)));
    return cosSinTurns(u.y) * radius;
}

/// Where in pixels from a pixel's middle a sample lies. Box: anywhere in the pixel, with the same weight.
vec2 filterOffset(vec2 u, uint kind) {
    if (kind == MINIRT_FILTER_TENT) return vec2(tentOffset(u.x), tentOffset(u.y));
    if (kind == MINIRT_FILTER_GAUSSIAN) return gaussianOffset(u);
    return u - vec2(real(0.5));
}
