// Random numbers by counting: each is a function of (pixel, sample, bounce, dimension), so that no state is kept and every way of
// scheduling paths draws the same ones. Integers to the last step: the same bits on every device. GLSL and C++ (tests/shader_source.hpp).
//
// Two kinds: randomPair draws independent numbers; sobolPair draws points that fill the square evenly over the samples of a pixel, which
// lets the mean converge faster. Bounces and dimensions (of sobolPair: pairs of dimensions) count from 0 and lie below 65536.

/// Four numbers of 32 bits; each depends on all bits of v (pcg4d; Jarzynski and Olano 2020, Hash Functions for GPU Rendering).
uvec4 hashBits(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// The upper 24 bits as a number in [0,1): a multiple of 2^-24, which float holds exactly.
real unitReal(uint bits) { return real(bits >> 8u) * real(1.0 / 16777216.0); }

/// A point of the unit square, independent of all others.
vec2 randomPair(uvec2 pixel, uint sampleIndex, uint bounce, uint dimension) {
    uvec4 bits = hashBits(uvec4(pixel.x, pixel.y, sampleIndex, bounce << 16u | dimension));
    return vec2(unitReal(bits.x), unitReal(bits.y));
}

/// A permutation of 32-bit numbers in which each bit depends on itself, the bits below and the seed: Owen's nested scrambling of a
/// bit-reversed number (Laine and Karras 2011; constants of Vegdahl 2021, Building a Better LK Hash).
uint scrambleUpwards(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

/// Owen's nested uniform scrambling of a fraction of 32 bits: each bit depends on itself, the bits above and the seed.
uint owenScramble(uint x, uint seed) { return bitfieldReverse(scrambleUpwards(bitfieldReverse(x), seed)); }

/// The second coordinate of Sobol's sequence, its bits in reverse. The direction numbers form Pascal's triangle modulo 2: bit j of the result
/// is the parity of those bits k of the index that have all bits of j set in k, which five steps add up.
uint sobolReversed(uint index) {
    index ^= (index >> 16u) & 0x0000ffffu;
    index ^= (index >> 8u) & 0x00ff00ffu;
    index ^= (index >> 4u) & 0x0f0f0f0fu;
    index ^= (index >> 2u) & 0x33333333u;
    return index ^ ((index >> 1u) & 0x55555555u);
}

/// The first two coordinates of point `index` of Sobol's sequence, fractions of 32 bits.
uvec2 sobolBits(uint index) { return uvec2(bitfieldReverse(index), bitfieldReverse(sobolReversed(index))); }

/// sobolPair as fractions of 32 bits: bit-reversed, Sobol's points are the index itself and sobolReversed of it, which the scrambling takes
/// as they are.
uvec2 sobolPairBits(uvec2 pixel, uint sampleIndex, uint bounce, uint pair) {
    uvec4 seed = hashBits(uvec4(pixel.x, pixel.y, 0x50b01e57u, bounce << 16u | pair));
    uint shuffled = owenScramble(sampleIndex, seed.x);
    return uvec2(bitfieldReverse(scrambleUpwards(shuffled, seed.y)), bitfieldReverse(scrambleUpwards(sobolReversed(shuffled), seed.z)));
}

/// A point of the unit square. Over the samples of a pixel: Sobol's first two coordinates, scrambled after Owen; every first 2^k samples are
/// a (0,k,2)-net. Pairs are padded: each shuffles the order of the points by its own seed, so that they do not correlate (Burley 2020,
/// Practical Hash-based Owen Scrambling).
vec2 sobolPair(uvec2 pixel, uint sampleIndex, uint bounce, uint pair) {
    uvec2 bits = sobolPairBits(pixel, sampleIndex, bounce, pair);
    return vec2(unitReal(bits.x), unitReal(bits.y));
}
