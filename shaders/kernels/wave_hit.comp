// Wavefront: paths that have met a surface pick a light and choose where to go on.

void main() {
    uint slot = queuedPath(MINIRT_QUEUE_HITS);
    if (slot == MINIRT_NONE) return;
    Path path = loadPath(slot);
    Traversal ray = loadRay(slot, false);
    uvec2 rays = uvec2(0u);
    Traversal before = meetSurface(path, ray, encounterOf(path, ray), taskOf(slot).pixel);
    ray = nextRay(path, before, rays);
    queuePath(slot, path, ray, shadowsOf(frame.sampling.w), rays);
}
