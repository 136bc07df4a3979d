// Path tracing as one kernel: an invocation follows a path to its end. Each pass of the loop traces one ray, so there is one trace site. A pixel that
// spends its budget of steps saves where it is and goes on in the next dispatch.

/// The ray in flight is done: gives the next one. None is left where the phase is PHASE_DONE.
Traversal follow(inout Path path, Traversal ray, uvec2 pixel, inout uvec2 rays) {
    bool hit = ray.slot != MINIRT_NONE;
    bool toLight = path.phase == PHASE_SHADOW;
    Encounter e = encounterOf(path, ray);
    Traversal before = noRay();
    if (!toLight && hit) before = meetSurface(path, ray, e, pixel);
    if (!toLight && !hit) meetNothing(path);
    if (toLight && looksThrough(ray)) before = passShadow(path, ray, e);
    if (toLight && !hit) addPicked(path, ray);
    return nextRay(path, before, rays);
}

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    Path path;
    Traversal ray;
    if (frame.sampling.w != 0u) {
        uint word = 0u;
        path = takePath(task.slot, word);
        if (path.phase == PHASE_DONE) return;
        ray = takeTraversal(task.slot, word, path.phase == PHASE_SHADOW && !SHADOWS_PASS);
    } else {
        ray = beginPath(task.pixel, path);
    }
    uvec2 rays = uvec2(0u);
    uint steps = 0u;
    do {
        traverse(ray, steps, STEP_BUDGET);
        if (!isDone(ray) || steps >= STEP_BUDGET) break;
        ray = follow(path, ray, task.pixel, rays);
        steps++;
    } while (path.phase != PHASE_DONE);
    bool finished = path.phase == PHASE_DONE;
    addToFilm(task.filmIndex, finished ? clamped(path.radiance) : vec3(0.0), finished, rays);
    uint word = 0u;
    putPath(task.slot, word, path);
    if (finished) return;
    putTraversal(task.slot, word, ray);
    atomicAdd(counters.pending, 1u);
    if (frame.size.w != 0u) atomicAdd(counters.unfinished, 1u);
}
