// Queues of paths between the kernels of the wavefront. A path is in one queue at most; the queue holds its slot in the state buffer, where the path and
// its ray in flight are. Headers are what indirect dispatches read; the host resets those of a round (minirt.h).

layout(std430, binding = MINIRT_BINDING_QUEUES) buffer QueueBuffer { uint queueWords[]; };

/// Rounds of even and odd numbers take turns with two queues of rays and of shadow rays: one is read while the other fills.
uint raysOf(uint round) { return (round & 1u) == 0u ? MINIRT_QUEUE_EVEN_RAYS : MINIRT_QUEUE_ODD_RAYS; }
uint shadowsOf(uint round) { return (round & 1u) == 0u ? MINIRT_QUEUE_EVEN_SHADOWS : MINIRT_QUEUE_ODD_SHADOWS; }

uint queueStart(uint queue) { return MINIRT_QUEUE_COUNT * MINIRT_QUEUE_HEADER_WORDS + queue * frame.size.z; }

/// All invocations that get here together push into the same queue: one of them makes room for all.
void pushPath(uint queue, uint slot) {
    uint header = queue * MINIRT_QUEUE_HEADER_WORDS;
    uvec4 together = subgroupBallot(true);
    uint count = subgroupBallotBitCount(together);
    uint first = 0u;
    if (subgroupElect()) {
        first = atomicAdd(queueWords[header + 3u], count);
        uint size = gl_WorkGroupSize.x;
        uint groups = (first + count + size - 1u) / size - (first + size - 1u) / size;
        if (groups > 0u) atomicAdd(queueWords[header], groups);
    }
    first = subgroupBroadcastFirst(first);
    queueWords[queueStart(queue) + first + subgroupBallotExclusiveBitCount(together)] = slot;
}

/// The path of this invocation, or MINIRT_NONE.
uint queuedPath(uint queue) {
    uint place = gl_GlobalInvocationID.x;
    return place < queueWords[queue * MINIRT_QUEUE_HEADER_WORDS + 3u] ? queueWords[queueStart(queue) + place] : MINIRT_NONE;
}

// What a slot holds: the path, then its ray in flight.

const uint RAY_WORD = MINIRT_PATH_WORDS(SAVED_VOLUMES);

void savePath(uint slot, Path path) {
    uint word = 0u;
    putPath(slot, word, path);
}

Path loadPath(uint slot) {
    uint word = 0u;
    return takePath(slot, word);
}

void saveRay(uint slot, Traversal ray) {
    uint word = RAY_WORD;
    putTraversal(slot, word, ray);
}

Traversal loadRay(uint slot, bool anyHit) {
    uint word = RAY_WORD;
    return takeTraversal(slot, word, anyHit);
}

/// A path that leaves the scene where nothing shines, and no ray needs to know which volumes it has left, is done.
const bool MISSES_MATTER = BACKGROUND_SHINES || TRACKS_VOLUMES || MEDIA_SHINE;

void endPath(uint slot) {
    uint word = 0u;
    putWord(slot, word, PHASE_DONE);
}

/// Where a path waits for what it does next; one that is done waits nowhere.
void queuePath(uint slot, Path path, Traversal ray, uint shadows, uvec2 rays) {
    savePath(slot, path);
    rayCounts[taskOf(slot).filmIndex] += rays;
    if (path.phase == PHASE_DONE) return;
    saveRay(slot, ray);
    if (path.phase == PHASE_SHADOW)
        pushPath(shadows, slot);
    else
        pushPath(raysOf(frame.sampling.w + 1u), slot);
}
