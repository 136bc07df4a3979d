// rays.comp for measuring: without what lets a ray go on in a later dispatch, which costs a third of the time of a short ray on devices
// that run both sides of every branch, and without a picture. A ray whose budget of steps does not last counts as pending: the host
// traces it by rays.comp.

layout(binding = MINIRT_BINDING_ENVIRONMENT) uniform usamplerBuffer rayTexels;  // the same rays again, for CPU drivers

Traversal fetchQuery(uint index) {
    if (!FETCH_TEXELS) return beginQuery(index);
    vec4 a = uintBitsToFloat(texelFetch(rayTexels, int(index * 2u)));
    vec4 b = uintBitsToFloat(texelFetch(rayTexels, int(index * 2u + 1u)));
    return beginTraversal(a.xyz, b.xyz, b.w, frame.sampling.y != 0u);
}

/// Rays are read from memory in their order, and a core reads ahead; pictures are not, where what counts is that both cores get as much to do.
const uint RAY_GROUPS_IN_CHUNK = 32u;

void main() {
    uint lane = gl_LocalInvocationIndex;
    uint inBlock = everySecondBit(lane) + everySecondBit(lane >> 1) * 8u;
    uint index = (frame.blocks.x + groupNumber(RAY_GROUPS_IN_CHUNK)) * gl_WorkGroupSize.x + inBlock;
    Traversal ray = fetchQuery(index);
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    storeWork(index);
    queryHits[index] = QueryHit(ray.t, ray.slot);
    if (!isDone(ray)) atomicAdd(counters.pending, 1u);
}
