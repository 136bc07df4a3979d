// Segments wait on a list of their pixel's own, in its state.

/// The pixel that a walk is for.
struct Owner {
    uint slot;
    uvec2 pixel;
};

uvec2 pixelOf(Owner owner) { return owner.pixel; }

/// The walk itself follows one of the rays that leave a surface, after the shadow rays.
const bool ALL_BRANCHES_WAIT = false;

bool hold(uint slot, inout TreeWalk walk, Segment segment) {
    if (walk.waiting >= frame.size.z) return false;
    uint word = waitingWord(walk.waiting++);
    putSegment(slot, word, segment);
    return true;
}
