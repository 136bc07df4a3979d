// Wavefront: shadow rays. One that passes a surface, or spends its budget of steps, goes on in the next round.

void main() {
    uint slot = queuedPath(shadowsOf(frame.sampling.w));
    if (slot == MINIRT_NONE) return;
    Traversal ray = loadRay(slot, !SHADOWS_PASS);
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    uint onwards = shadowsOf(frame.sampling.w + 1u);
    if (!isDone(ray)) {
        saveRay(slot, ray);
        pushPath(onwards, slot);
        return;
    }
    Path path = loadPath(slot);
    uvec2 rays = uvec2(0u);
    Traversal before = noRay();
    if (looksThrough(ray)) before = passShadow(path, ray, encounterOf(path, ray));
    if (ray.slot == MINIRT_NONE) addPicked(path, ray);
    ray = nextRay(path, before, rays);
    queuePath(slot, path, ray, onwards, rays);
}
