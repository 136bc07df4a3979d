// Rays of the host's against the scene: the renderer's traversal and nothing else, for tests and measurements. Blobs of minirtc do
// not hold it.

#define QUERY_DONE 0u
#define QUERY_PENDING 1u

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    uint word = 0u;
    Traversal ray;
    if (frame.sampling.w != 0u) {
        if (takeWord(task.slot, word) == QUERY_DONE) return;
        ray = takeTraversal(task.slot, word, frame.sampling.y != 0u);
    } else {
        ray = beginQuery(task.filmIndex);
    }
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    storeWork(task.filmIndex);
    word = 0u;
    putWord(task.slot, word, isDone(ray) ? QUERY_DONE : QUERY_PENDING);
    if (isDone(ray)) {
        queryHits[task.filmIndex] = QueryHit(ray.t, ray.slot);
    } else {
        putTraversal(task.slot, word, ray);
        atomicAdd(counters.pending, 1u);
    }
}
