// Effect `profile`, which no scene calls for: kernels of minirt-bench count what traversal does. Identity: not a token.

#ifdef EFFECT_PROFILE

/// Of one ray. A pass of a loop takes all lanes of a subgroup along; the first one that is in it counts it, so passes only mean something in sums.
struct RayWork {
    uvec4 own;     // node steps, triangle tests, leaves; the size of the subgroup
    uvec4 passes;  // of the loops over nodes and triangles; then those without a lane in them, which run all the same where lanes are masked
};

layout(std430, binding = MINIRT_BINDING_QUEUES) buffer WorkBuffer { RayWork worksOfRays[]; };

RayWork rayWork = RayWork(uvec4(0u, 0u, 0u, gl_SubgroupSize), uvec4(0u));

/// 1 for the first of the lanes that are here, else 0.
uint firstHere() { return uint(gl_SubgroupInvocationID == subgroupBallotFindLSB(subgroupBallot(true))); }

/// firstHere() where no lane enters the branch ahead and its body runs all the same.
uint firstMasked(bool enters) { return MASKS_LANES && subgroupBallot(enters) == uvec4(0u) ? firstHere() : 0u; }

void countNodeStep() {
    rayWork.own.x++;
    rayWork.passes.x += firstHere();
}

void countTriangleTest() {
    rayWork.own.y++;
    rayWork.passes.y += firstHere();
}

void countLeaf() { rayWork.own.z++; }

void countNodeBranch(bool enters) { rayWork.passes.z += firstMasked(enters); }

void countLeafBranch(bool enters) { rayWork.passes.w += firstMasked(enters); }

/// Together with what earlier dispatches have done of ray `index`.
void storeWork(uint index) {
    if (frame.sampling.w != 0u) {
        rayWork.own.xyz += worksOfRays[index].own.xyz;
        rayWork.passes += worksOfRays[index].passes;
    }
    worksOfRays[index] = rayWork;
}

#else

#define countNodeStep()
#define countTriangleTest()
#define countLeaf()
#define countNodeBranch(enters)
#define countLeafBranch(enters)
#define storeWork(index)

#endif
