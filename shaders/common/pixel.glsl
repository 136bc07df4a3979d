// Where groups lie in the grid, pixels in a group and samples in a pixel. GLSL and C++ (tests/shader_source.hpp).

/// Every second bit of x, packed: the inverse of Morton order.
uint everySecondBit(uint x) {
    x &= 0x55555555u;
    x = (x | x >> 1) & 0x33333333u;
    x = (x | x >> 2) & 0x0f0f0f0fu;
    return (x | x >> 4) & 0x00ff00ffu;
}

/// Where sample `index` lies in its pixel: the centre first, then the R2 low-discrepancy sequence (Roberts 2018).
vec2 pixelSample(uint index) {
    // Fixed point: the fractional parts stay exact for any index.
    uvec2 bits = uvec2(0x80000000u) + index * uvec2(3242174889u, 2447445414u);
    return vec2(bits >> 8u) * real(1.0 / 16777216.0);
}

/// A permutation of 0 .. groups - 1 that makes both halves alike: they get chunks in turn, of `mostInChunk` where there are many. In a chunk neighbours follow
/// each other, which is what caches read ahead.
uint interleaved(uint group, uint groups, uint mostInChunk) {
    uint chunk = clamp(groups / 64u, 1u, mostInChunk);
    uint paired = groups / (2u * chunk) * chunk;  // of each half, what is in chunks that take turns
    uint firstHalf = (groups + 1u) / 2u;
    bool second = group >= firstHalf;
    uint at = second ? group - firstHalf : group;
    uint inTurn = (at / chunk * 2u + (second ? 1u : 0u)) * chunk + at % chunk;
    return at < paired ? inTurn : second ? group : paired + at;
}
