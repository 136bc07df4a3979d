// Wavefront, last: finished paths add to their pixels; the others are counted.

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    uint word = 0u;
    uint phase = takeWord(task.slot, word) & 3u;
    if (phase != PHASE_DONE) {
        atomicAdd(counters.pending, 1u);
        if (frame.size.w != 0u) atomicAdd(counters.unfinished, 1u);
        return;
    }
    if (takeWord(task.slot, word) == MINIRT_NONE) return;  // added before
    addToFilm(task.filmIndex, clamped(takeVec3(task.slot, word)), true, uvec2(0u));
    word = 1u;
    putWord(task.slot, word, MINIRT_NONE);
}
