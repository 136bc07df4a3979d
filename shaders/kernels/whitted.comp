// Whitted's ray tracer (CACM 1980): a tree of mirror and refracted rays below each camera ray, hard shadows at every hit.
// Depth first: one ray is in flight, the other branch waits on the pixel's list. Each pass of the loop traces one ray, so there
// is one trace site. A pixel that spends its budget of steps saves where it is and goes on in the next dispatch.

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
        ray = nextRay(Owner(task.slot, task.pixel), walk, ray, steps, rays);
        steps += 2u;  // this pass, and the last one of the search for lights
    } while (walk.phase != PHASE_DONE);
    bool finished = walk.phase == PHASE_DONE;
    addToFilm(task.filmIndex, finished ? walk.radiance : vec3(0.0), finished, rays);
    saveWalk(task.slot, walk, ray);
    if (!finished) atomicAdd(counters.pending, 1u);
    if (!finished && frame.size.w != 0u) atomicAdd(counters.unfinished, 1u);
}
