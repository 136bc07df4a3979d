// rays.comp without what lets a ray go on in a later dispatch, which costs a third of the time of a short ray on devices that run both
// sides of every branch. One whose budget of steps does not last counts as pending: the host traces it by rays.comp.

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    Traversal ray = beginQuery(task.filmIndex);
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    queryHits[task.filmIndex] = QueryHit(ray.t, ray.slot);
    if (!isDone(ray)) atomicAdd(counters.pending, 1u);
}
