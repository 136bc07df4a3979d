// A pixel's walk through its tree of rays: what it keeps, in registers and between dispatches, and the rays that it sends out.

/// A ray of the tree.
struct Segment {
    vec3 origin;
    vec3 direction;
    vec3 throughput;
    uint depth;
    uint channel;        // of its light; 0: all of it
    VolumeList volumes;  // that it is in
};

// What the ray in flight is for.
#define PHASE_DONE 0u
#define PHASE_CLOSEST 1u
#define PHASE_SHADOW 2u
#define PHASE_CAMERA 3u  // on its way to the camera from outside of all volumes, to find out which volumes that is in

/// A pixel's progress through its tree. Its waiting segments are in the state buffer.
struct TreeWalk {
    uint phase;
    uint waiting;  // segments on the list
    Segment segment;
    uint hitSlot;  // where the segment ended
    float hitT;
    uint light;     // the next light to look at
    vec3 unshadowed;  // what the shadow ray's light adds unless it is blocked
    VolumeList shadowVolumes;  // that the shadow ray is in
    vec3 radiance;    // gathered so far; summed in one order wherever the work was cut, so that a picture does not depend on it
};

uint waitingWord(uint index) {
    return MINIRT_WALK_WORDS(SAVED_VOLUMES) + MINIRT_TRAVERSAL_WORDS + STACK_LEVELS + index * MINIRT_SEGMENT_WORDS(SAVED_VOLUMES);
}

void putSegment(uint slot, inout uint word, Segment segment) {
    putVec3(slot, word, segment.origin);
    putVec3(slot, word, segment.direction);
    putVec3(slot, word, segment.throughput);
    putWord(slot, word, packDepth(segment.depth, segment.channel));
    putVolumes(slot, word, segment.volumes);
}

Segment takeSegment(uint slot, inout uint word) {
    Segment segment;
    segment.origin = takeVec3(slot, word);
    segment.direction = takeVec3(slot, word);
    segment.throughput = takeVec3(slot, word);
    uint depth = takeWord(slot, word);
    segment.depth = depthIn(depth);
    segment.channel = channelIn(depth);
    segment.volumes = takeVolumes(slot, word);
    return segment;
}

void saveWalk(uint slot, TreeWalk walk, Traversal ray) {
    uint word = 0u;
    putWord(slot, word, walk.phase);
    if (walk.phase == PHASE_DONE) return;
    putWord(slot, word, walk.waiting);
    putSegment(slot, word, walk.segment);
    putWord(slot, word, walk.hitSlot);
    putFloat(slot, word, walk.hitT);
    putWord(slot, word, walk.light);
    putVec3(slot, word, walk.unshadowed);
    putVolumes(slot, word, walk.shadowVolumes);
    putVec3(slot, word, walk.radiance);
    putTraversal(slot, word, ray);
}

void loadWalk(uint slot, inout TreeWalk walk, inout Traversal ray) {
    uint word = 0u;
    walk.phase = takeWord(slot, word);
    if (walk.phase == PHASE_DONE) return;
    walk.waiting = takeWord(slot, word);
    walk.segment = takeSegment(slot, word);
    walk.hitSlot = takeWord(slot, word);
    walk.hitT = takeFloat(slot, word);
    walk.light = takeWord(slot, word);
    walk.unshadowed = takeVec3(slot, word);
    walk.shadowVolumes = takeVolumes(slot, word);
    walk.radiance = takeVec3(slot, word);
    ray = takeTraversal(slot, word, walk.phase == PHASE_SHADOW && !SHADOWS_PASS);
}

Traversal traceSegment(inout TreeWalk walk, Segment segment) {
    walk.phase = PHASE_CLOSEST;
    walk.segment = segment;
    return beginTraversal(segment.origin, segment.direction, MINIRT_RAY_END, false);
}

/// The ray of a pixel. Where the camera may be in a volume, another one comes first: to the camera, from outside of all volumes.
Traversal traceCamera(inout TreeWalk walk, uvec2 pixel, VolumeList volumes) {
    return traceSegment(walk, Segment(frame.position.xyz, cameraDirection(pixel, frame.sampling.x), vec3(1.0), 0u, 0u, volumes));
}

Traversal traceToCamera(inout TreeWalk walk) {
    Traversal ray = rayToCamera(frame.position.xyz);
    walk.phase = PHASE_CAMERA;
    walk.segment = Segment(ray.origin, ray.direction, vec3(0.0), 0u, 0u, noVolumes());
    return ray;
}

/// Light that adds less than this share of itself is not worth a shadow ray: a unit in the last place of what other lights add.
const float NEGLIGIBLE_SHARE = 5.9604644775390625e-8;

/// Looks for the next light that adds something at the surface, and starts the shadow ray towards it. Without one, or when the budget
/// of steps ends the search, the ray is empty.
Traversal traceShadow(inout TreeWalk walk, inout uint steps, Encounter e) {
    Traversal ray = noRay();
    walk.phase = PHASE_SHADOW;
    walk.unshadowed = vec3(0.0);
    walk.shadowVolumes = e.boundary.reflected;
    while (walk.light < lightCount() && ray.node == NODE_NONE && steps < STEP_BUDGET) {
        steps++;
        LightSample light = sampleLight(walk.light++, e.surface.p);
        float cosine = dot(e.n, light.toLight);
        vec3 share = e.material.diffuse.rgb * e.surface.diffuseTexture * max(cosine, 0.0);
        share += cosine > 0.0 ? highlight(e.material, e.n, light.toLight, -walk.segment.direction) : vec3(0.0);
        if (maxComponent(share) > NEGLIGIBLE_SHARE) {
            walk.unshadowed = walk.segment.throughput * share * light.irradiance;
            vec3 origin = offsetRayOrigin(e.surface.p + e.surface.lift, e.surface.pError, e.ng, e.ng);
            ray = beginTraversal(origin, light.toLight, light.distance, !SHADOWS_PASS);
        }
    }
    return ray;
}

/// Whether a ray of this throughput carries more than the cut-off.
bool isStrong(vec3 throughput) { return importance(throughput) > frame.position.w; }

/// Whether a ray is followed: MIRROR_RAY or REFRACTED_RAY, from where the walk's segment has ended. The lever `weak_rays` has another answer.
#define MIRROR_RAY 0u
#define REFRACTED_RAY 1u
#define carriesOn(throughput, walk, which) isStrong(throughput)
