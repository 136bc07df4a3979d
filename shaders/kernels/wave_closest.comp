// Wavefront: rays that look for the closest surface. One that spends its budget of steps goes on in the next round.

void main() {
    uint slot = queuedPath(raysOf(frame.sampling.w));
    if (slot == MINIRT_NONE) return;
    Traversal ray = loadRay(slot, false);
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    saveRay(slot, ray);
    pushPath(!isDone(ray) ? raysOf(frame.sampling.w + 1u) : ray.slot == MINIRT_NONE ? MINIRT_QUEUE_MISSES : MINIRT_QUEUE_HITS, slot);
}
