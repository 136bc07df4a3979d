// What happens where a ray of the tree ends. The file before it says where segments wait: `bool hold(uint slot, inout TreeWalk walk, Segment segment)`, of the
// pixel `slot`; which of them do, `ALL_BRANCHES_WAIT`; and what is known of that pixel, `Owner`.

/// A segment waits for its turn, or is lost and counted where there is no room.
void holdOrCount(uint slot, inout TreeWalk walk, Segment segment) {
    if (!hold(slot, walk, segment)) atomicAdd(counters.segment_overflow, 1u);
}

/// All light together that meets a medium which disperses goes on as one of its channels. The others wait, to come here by themselves.
void divideLight(uint slot, uvec2 pixel, inout TreeWalk walk, inout Encounter e) {
    if (walk.segment.channel != 0u || !dividesLight(e.boundary)) return;
    Segment whole = walk.segment;
    UNROLL for (int k = int(CHANNELS) - 1; k >= 0; k--) {
        walk.segment.channel = channelAt(uint(k), pixel);
        walk.segment.throughput = whole.throughput * channelShare(walk.segment.channel);
        if (k > 0) holdOrCount(slot, walk, walk.segment);
    }
    e.eta = iorRatio(e.boundary, e.material, e.entering, walk.segment.channel);
}

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

/// The rays that leave a surface.
struct Branches {
    bool reflects, refracts;
    Segment reflected, refracted;
};

Branches branchesAt(TreeWalk walk, bool hit, Encounter e) {
    Segment from = walk.segment;
    Scatter branches = scatter(e.material, from.direction, e.ng, dot(from.direction, e.n) < 0.0 ? e.n : e.ng, e.eta);
    bool straight = e.boundary.skipped;  // costs no depth
    vec3 reflectThroughput = straight ? vec3(0.0) : from.throughput * branches.reflectWeight;
    vec3 refractThroughput = straight ? from.throughput : from.throughput * branches.refractWeight;
    bool deeper = hit && (straight || from.depth < frame.sampling.z);
    Branches leaving;
    leaving.reflects = deeper && carriesOn(reflectThroughput, walk, MIRROR_RAY);
    leaving.refracts = deeper && carriesOn(refractThroughput, walk, REFRACTED_RAY);
    leaving.reflected = Segment(aboveSurface(e), branches.reflected, reflectThroughput, from.depth + 1u, from.channel, e.boundary.reflected);
    leaving.refracted = Segment(belowSurface(e), straight ? from.direction : branches.refracted, refractThroughput,
                                straight ? from.depth : from.depth + 1u, from.channel, e.boundary.transmitted);
    return leaving;
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

/// Where all branches wait.
void holdBranches(uint slot, inout TreeWalk walk, bool hit, Encounter e) {
    Branches leaving = branchesAt(walk, hit, e);
    if (leaving.reflects) holdOrCount(slot, walk, leaving.reflected);
    if (leaving.refracts) holdOrCount(slot, walk, leaving.refracted);
}

/// Where not all do: follows one of the rays that leave the surface, puts the other on the list; with none, takes one from the list.
Traversal nextSegment(uint slot, inout TreeWalk walk, bool hit, Encounter e) {
    Branches leaving = branchesAt(walk, hit, e);
    if (leaving.reflects && leaving.refracts) holdOrCount(slot, walk, leaving.reflected);
    if (leaving.refracts) return traceSegment(walk, leaving.refracted);
    if (leaving.reflects) return traceSegment(walk, leaving.reflected);
    walk.phase = PHASE_DONE;
    if (walk.waiting > 0u) {
        uint word = waitingWord(--walk.waiting);
        return traceSegment(walk, takeSegment(slot, word));
    }
    return beginTraversal(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, false);
}

/// The ray has ended: gathers what it brings and begins the next one of the walk. Without one, the walk is done.
Traversal nextRay(Owner owner, inout TreeWalk walk, Traversal ray, inout uint steps, inout uvec2 rays) {
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
    if (arrived && hit) divideLight(owner.slot, pixelOf(owner), walk, e);
    if (arrived) {
        arrive(walk, hit, e);
        if (ALL_BRANCHES_WAIT) holdBranches(owner.slot, walk, hit, e);
    }
    if (walk.phase == PHASE_SHADOW && !stopped) walk.radiance += walk.unshadowed * transmittance(mediumAround(walk.shadowVolumes), ray.t);
    if (clear) {
        ray = passShadow(walk, ray, e);
        rays.x += isDone(ray) ? 0u : 1u;
    } else if (toCamera && stopped) {
        ray = passToCamera(ray, frame.position.xyz, e);
        walk.segment.origin = ray.origin;
        walk.segment.volumes = e.boundary.transmitted;
    } else if (toCamera) {
        ray = traceCamera(walk, pixelOf(owner), walk.segment.volumes);
    } else {
        if (hit && walk.light < lightCount()) {
            ray = traceShadow(walk, steps, e);
            rays.x += isDone(ray) ? 0u : 1u;
        }
        bool allLightsSeen = isDone(ray) && walk.light == lightCount();
        if (!hit || allLightsSeen) {
            if (ALL_BRANCHES_WAIT) {
                walk.phase = PHASE_DONE;
            } else {
                ray = nextSegment(owner.slot, walk, hit, e);
                rays.y += walk.phase == PHASE_CLOSEST ? 1u : 0u;
            }
        }
    }
    return ray;
}
