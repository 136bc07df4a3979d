// Whitted's ray tracer (CACM 1980): a tree of mirror and refracted rays below each camera ray, hard shadows at every hit.
// Depth first: one ray is in flight, the other branch waits on the pixel's list. Each pass of the loop traces one ray, so there
// is one trace site. A pixel that spends its budget of steps saves where it is and goes on in the next dispatch.

/// Follows one of the rays that leave the surface, puts the other on the list; with none, takes one from the list.
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
        if (arrived && hit) divideLight(task.slot, task.pixel, walk, e);
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
