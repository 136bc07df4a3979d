// Whitted's ray tracer (CACM 1980): a tree of mirror and refracted rays below each camera ray, hard shadows at every hit.
// Depth first: one ray is in flight, the other branch waits on the pixel's list. Each pass of the loop traces one ray, so there
// is one trace site. A pixel that spends its budget of steps saves where it is and goes on in the next dispatch.

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
    bool reflects = deeper && carriesOn(reflectThroughput, walk, MIRROR_RAY);
    bool refracts = deeper && carriesOn(refractThroughput, walk, REFRACTED_RAY);
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
