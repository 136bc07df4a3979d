// Wavefront, first: a path for each pixel of the dispatch.

void main() {
    PixelTask task = pixelTask();
    Path path = noPath();
    Traversal ray = noRay();
    if (task.valid) ray = beginPath(task.pixel, path);
    savePath(task.slot, path);
    if (!task.valid) return;
    saveRay(task.slot, ray);
    pushPath(raysOf(frame.sampling.w), task.slot);
}
