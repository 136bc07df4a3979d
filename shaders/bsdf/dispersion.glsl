// Light of different wavelengths. GLSL and C++ (tests/shader_source.hpp).

/// Index of refraction at c = 1 / wavelength^2: the sum of low.x / c, low.y, low.z c, low.w c^2, c3 c^3 and c4 c^4.
real indexOnCurve(vec4 low, real c3, real c4, real c) { return low.x / c + (low.y + c * (low.z + c * (low.w + c * (c3 + c * c4)))); }

/// All bits of x depend on all bits of the result and the other way round (lowbias32, Wellons 2018).
uint scatterBits(uint x) {
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

/// Where in a table of 2^`bits` equally likely wavelengths the k-th of four lies that a sample of a pixel follows: the hero, k = 0, steps by
/// the golden ratio from sample to sample; the others are spread evenly from it (Wilkie et al. 2014, hero wavelength sampling).
uint wavelengthEntry(uvec2 pixel, uint sampleIndex, uint k, uint bits) {
    uint hero = scatterBits(pixel.x + scatterBits(pixel.y)) + sampleIndex * 2654435769u;
    return (hero + k * 0x40000000u) >> (32u - bits);
}
