// Whitted's ray tracer (CACM 1980): a tree of mirror and refracted rays below each camera ray, hard shadows at every hit.
// Depth first: one ray is in flight, the other branch waits on the pixel's list. Each pass of the loop traces one ray, so there
// is one trace site. A pixel that spends its budget of steps saves where it is and goes on in the next dispatch.

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

/// All light together that meets a medium which disperses goes on as one of its channels. The others wait, to come here by themselves.
void divideLight(PixelTask task, inout TreeWalk walk, inout Encounter e) {
    if (walk.segment.channel != 0u || !dividesLight(e.boundary)) return;
    Segment whole = walk.segment;
    UNROLL for (int k = int(CHANNELS) - 1; k >= 0; k--) {
        walk.segment.channel = channelAt(uint(k), task.pixel);
        walk.segment.throughput = whole.throughput * channelShare(walk.segment.channel);
        bool room = walk.waiting < frame.size.z;
        if (k > 0 && room) {
            uint word = waitingWord(walk.waiting++);
            putSegment(task.slot, word, walk.segment);
        }
        if (k > 0 && !room) atomicAdd(counters.segment_overflow, 1u);
    }
    e.eta = iorRatio(e.boundary, e.material, e.entering, walk.segment.channel);
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

bool carriesOn(vec3 weight) { return importance(weight) > frame.position.w; }

/// The shadow ray goes on behind a surface that is clear or hidden, tinted; it ends there when too little of its light is left.
Traversal passShadow(inout TreeWalk walk, Traversal ray, Encounter e) {
    vec3 share = transmittance(e.boundary.from, ray.t);
    if (!e.boundary.skipped) share *= passingShare(e.material, ray.direction, dot(ray.direction, e.n) < 0.0 ? e.n : e.ng, e.eta);
    walk.unshadowed *= share;
    walk.shadowVolumes = e.boundary.transmitted;
    LightSample light = sampleLight(walk.light - 1u, e.surface.p);
    Traversal onwards = beginTraversal(belowSurface(e), ray.direction, light.distance, false);
    if (importance(walk.unshadowed) <= 0.0) onwards.node = NODE_NONE;
    return onwards;
}

/// Follows one of the rays that leave the surface, puts the other on the list; with none, takes one from the list.
Traversal nextSegment(uint slot, inout TreeWalk walk, bool hit, Encounter e) {
    Traversal ray = beginTraversal(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, false);
    Segment from = walk.segment;
    Scatter branches = scatter(e.material, from.direction, e.ng, dot(from.direction, e.n) < 0.0 ? e.n : e.ng, e.eta);
    bool straight = e.boundary.skipped;  // costs no depth
    vec3 reflectThroughput = straight ? vec3(0.0) : from.throughput * branches.reflectWeight;
    vec3 refractThroughput = straight ? from.throughput : from.throughput * branches.refractWeight;
    bool deeper = hit && (straight || from.depth < frame.sampling.z);
    bool reflects = deeper && carriesOn(reflectThroughput);
    bool refracts = deeper && carriesOn(refractThroughput);
    Segment reflected = Segment(aboveSurface(e), branches.reflected, reflectThroughput, from.depth + 1u, from.channel, e.boundary.reflected);
    Segment refracted = Segment(belowSurface(e), straight ? from.direction : branches.refracted, refractThroughput,
                                straight ? from.depth : from.depth + 1u, from.channel, e.boundary.transmitted);
    bool room = walk.waiting < frame.size.z;
    if (reflects && refracts && room) {
        uint word = waitingWord(walk.waiting++);
        putSegment(slot, word, reflected);
    }
    if (reflects && refracts && !room) atomicAdd(counters.segment_overflow, 1u);
    if (refracts) return traceSegment(walk, refracted);
    if (reflects) return traceSegment(walk, reflected);
    walk.phase = PHASE_DONE;
    if (walk.waiting > 0u) {
        uint word = waitingWord(--walk.waiting);
        return traceSegment(walk, takeSegment(slot, word));
    }
    return ray;
}

/// A segment has ended: what its medium takes and adds on the way, then the background or what shines by itself.
void arrive(inout TreeWalk walk, bool hit, Encounter e) {
    uint medium = hit ? e.boundary.from : mediumAround(walk.segment.volumes);
    float distance = hit ? walk.hitT : MINIRT_RAY_END;
    walk.radiance += walk.segment.throughput * inscattered(medium, distance);
    walk.segment.throughput *= transmittance(medium, distance);
    vec3 shine = hit ? (e.boundary.skipped ? vec3(0.0) : emission(e.material, e.entering, e.surface.uv)) : backgroundRadiance(walk.segment.direction);
    walk.radiance += walk.segment.throughput * shine;
    walk.light = e.boundary.skipped ? lightCount() : 0u;
}

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    Segment none = Segment(vec3(0.0), vec3(0.0), vec3(0.0), 0u, 0u, noVolumes());
    TreeWalk walk = TreeWalk(PHASE_DONE, 0u, none, MINIRT_NONE, 0.0, 0u, vec3(0.0), noVolumes(), vec3(0.0));
    Traversal ray;
    if (frame.sampling.w != 0u) {
        loadWalk(task.slot, walk, ray);
        if (walk.phase == PHASE_DONE) return;
    } else if (TRACKS_VOLUMES && (frame.sampling.y & MINIRT_FRAME_CAMERA_INSIDE) != 0u) {
        ray = traceToCamera(walk);
    } else {
        ray = traceCamera(walk, task.pixel, noVolumes());
    }
    uvec2 rays = uvec2(0u);
    uint steps = 0u;
    do {
        traverse(ray, steps, STEP_BUDGET);
        if (!isDone(ray) || steps >= STEP_BUDGET) break;
        bool arrived = walk.phase == PHASE_CLOSEST;
        bool toCamera = TRACKS_VOLUMES && walk.phase == PHASE_CAMERA;
        bool stopped = ray.slot != MINIRT_NONE;
        bool clear = SHADOWS_PASS && walk.phase == PHASE_SHADOW && stopped && mayBeClear(ray.slot);
        if (arrived) {
            walk.hitSlot = ray.slot;
            walk.hitT = ray.t;
        }
        // The surface that matters now: where this ray passes through, or where the segment ended.
        bool passing = clear || (toCamera && stopped);
        bool hit = passing || (!toCamera && walk.hitSlot != MINIRT_NONE);
        uint slot = passing ? ray.slot : walk.hitSlot;
        Encounter e = encounterAt(passing ? ray.origin : walk.segment.origin, passing ? ray.direction : walk.segment.direction,
                                  hit ? slot : 0u, passing ? ray.t : walk.hitT, clear ? walk.shadowVolumes : walk.segment.volumes, walk.segment.channel);
        if (hit && e.boundary.overflow) atomicAdd(counters.volume_overflow, 1u);
        if (arrived && hit) divideLight(task, walk, e);
        if (arrived) arrive(walk, hit, e);
        if (walk.phase == PHASE_SHADOW && !stopped) walk.radiance += walk.unshadowed * transmittance(mediumAround(walk.shadowVolumes), ray.t);
        if (clear) {
            ray = passShadow(walk, ray, e);
            rays.x += isDone(ray) ? 0u : 1u;
        } else if (toCamera && stopped) {
            ray = passToCamera(ray, frame.position.xyz, e);
            walk.segment.origin = ray.origin;
            walk.segment.volumes = e.boundary.transmitted;
        } else if (toCamera) {
            ray = traceCamera(walk, task.pixel, walk.segment.volumes);
        } else {
            if (hit && walk.light < lightCount()) {
                ray = traceShadow(walk, steps, e);
                rays.x += isDone(ray) ? 0u : 1u;
            }
            bool allLightsSeen = isDone(ray) && walk.light == lightCount();
            if (!hit || allLightsSeen) {
                ray = nextSegment(task.slot, walk, hit, e);
                rays.y += walk.phase == PHASE_CLOSEST ? 1u : 0u;
            }
        }
        steps += 2u;  // this pass, and the last one of the search for lights
    } while (walk.phase != PHASE_DONE);
    bool finished = walk.phase == PHASE_DONE;
    addToFilm(task.filmIndex, finished ? walk.radiance : vec3(0.0), finished, rays);
    saveWalk(task.slot, walk, ray);
    if (!finished) atomicAdd(counters.pending, 1u);
    if (!finished && frame.size.w != 0u) atomicAdd(counters.unfinished, 1u);
}
