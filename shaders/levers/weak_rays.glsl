// Lever `weak_rays`: rays of Whitted's tree that carry no more than the cut-off do not end there, they play Russian roulette. Who survives carries the
// cut-off, so that the picture is right in the mean for any cut-off.

#ifdef WEAK_RAYS_ROULETTE

/// A number in [0,1] for each of the rays that leave where a segment has ended: one number from either end, so that of two weak rays more often one
/// survives than both or none. The middle of one of 2^23 steps, so that no weight grows without bound. A hash of the segment, of which there is no second
/// one in a picture: the same wherever the work was cut.
real survivalLot(Segment segment, uint which) {
    uvec4 bits = hashBits(uvec4(floatBitsToUint(segment.origin), packDepth(segment.depth, segment.channel)));
    bits = hashBits(bits ^ uvec4(floatBitsToUint(segment.direction), frame.sampling.x));
    bits = hashBits(bits ^ uvec4(frame.blocks.z));
    real lot = (real(bits.x >> 9u) + real(0.5)) * real(1.0 / 8388608.0);
    return which == MIRROR_RAY ? lot : 1.0 - lot;
}

/// With the probability of the ray's share of the cut-off, which it then carries.
bool survives(inout vec3 throughput, TreeWalk walk, uint which) {
    if (isStrong(throughput)) return true;
    real weight = importance(throughput), cutoff = frame.position.w;
    if (!(survivalLot(walk.segment, which) * cutoff < weight)) return false;  // nor does NaN survive
    throughput *= cutoff / weight;
    return true;
}

#undef carriesOn
#define carriesOn survives

#endif
