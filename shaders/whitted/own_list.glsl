// Segments wait on a list of their pixel's own, in its state.

bool hold(uint slot, inout TreeWalk walk, Segment segment) {
    if (walk.waiting >= frame.size.z) return false;
    uint word = waitingWord(walk.waiting++);
    putSegment(slot, word, segment);
    return true;
}
