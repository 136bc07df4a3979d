// Wavefront: paths that have left the scene.

void main() {
    uint slot = queuedPath(MINIRT_QUEUE_MISSES);
    if (slot == MINIRT_NONE) return;
    Path path = loadPath(slot);
    uvec2 rays = uvec2(0u);
    meetNothing(path);
    Traversal ray = nextRay(path, noRay(), rays);
    queuePath(slot, path, ray, MINIRT_NONE, rays);
}
