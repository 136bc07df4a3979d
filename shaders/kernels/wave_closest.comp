// Wavefront: rays that look for the closest surface. One that spends its budget of steps goes on in the next round.

void main() {
    uint slot = queuedPath(raysOf(frame.sampling.w));
    if (slot == MINIRT_NONE) return;
    Traversal ray = loadRay(slot, false);
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    bool missed = isDone(ray) && ray.slot == MINIRT_NONE;
    if (missed && !MISSES_MATTER) {
        endPath(slot);
        return;
    }
    saveRay(slot, ray);
    if (!isDone(ray))
        pushPath(raysOf(frame.sampling.w + 1u), slot);
    else if (missed)
        pushPath(MINIRT_QUEUE_MISSES, slot);
    else
        pushPath(MINIRT_QUEUE_HITS, slot);
}
