// Whitted's ray tracer as in whitted.comp, for trees that are long here and short there: each segment is a piece of work by itself, for any lane. Lanes without
// work get what others have too much of, so that a frame does not last as long as one lane takes for its longest tree.
// frame.sampling.w: 0 begins the pixels of the dispatch, 1 goes on with them, 2 adds them to the film when all are done. frame.size.z: places of a ring for each
// lane. frame.blocks.w: pixels of the dispatch, with those outside of the picture.

/// So many segments more than it has lanes a subgroup keeps for itself while nobody waits, where its ring has room for four times as many.
const uint KEPT = 128u;

/// So many lanes of a subgroup are enough while lanes elsewhere wait: rays of one subgroup that go different ways hold each other up.
const uint ENOUGH = 8u;

/// Half of the queue at most: all subgroups together may put as many again into it before they see each other's.
const int MOST_QUEUED = int(MINIRT_SHARED_QUEUE / 2u);

/// Tickets for segments to come are drawn up to a quarter of the queue ahead, so that a place is never that of two.
const int MOST_AWAITED = int(MINIRT_SHARED_QUEUE / 4u);

/// Tries of a subgroup without work, after which it leaves: devices need not let others work on while one waits.
const uint MOST_TRIES = 4096u;

/// Of a lane, after which its subgroup leaves what it has to the next dispatch: the lane's segment has as many steps again to end.
const uint MOST_STEPS = STEP_BUDGET / 2u;

/// A lane's work: a segment, and the shadow rays from where it ends.
struct Lane {
    TreeWalk walk;
    Traversal ray;
    uint slot;    // of the pixel
    uint ticket;  // for a segment that is not there yet, or MINIRT_NONE
    uvec2 rays;   // shadow rays, secondary rays
    uint steps;
};

/// The same for all lanes of a subgroup.
struct Crew {
    uint oldest;  // on the ring
    bool works;   // and counts in LIVE
    bool allBegun;
    bool othersWait;
    bool leaves;
    uint tries;
};

bool works(Lane lane) { return lane.walk.phase != PHASE_DONE; }
bool isIdle(Lane lane) { return !works(lane) && lane.ticket == MINIRT_NONE; }
uint countOf(bool which) { return subgroupBallotBitCount(subgroupBallot(which)); }
uint rankAmong(bool which) { return subgroupBallotExclusiveBitCount(subgroupBallot(which)); }

/// Of a word that others change, the same value for all lanes.
uint lookAt(uint word) {
    uint value = 0u;
    if (subgroupElect()) value = sharedWords[word];
    return subgroupBroadcastFirst(value);
}

/// For all lanes at once: what the word was.
uint addOnce(uint word, uint value) {
    uint before = 0u;
    if (subgroupElect()) before = atomicAdd(sharedWords[word], value);
    return subgroupBroadcastFirst(before);
}

void beginSegment(inout Lane lane, PackedSegment packed) {
    Segment segment = unpack(packed, lane.slot);
    lane.ray = traceSegment(lane.walk, segment);
    lane.rays.y++;
}

void beginPixel(inout Lane lane, uint slot) {
    PixelTask task = taskOf(slot);
    if (!task.valid) return;
    lane.slot = slot;
    bool inside = TRACKS_VOLUMES && (frame.sampling.y & MINIRT_FRAME_CAMERA_INSIDE) != 0u;
    if (inside) lane.ray = traceToCamera(lane.walk);
    if (!inside) lane.ray = traceCamera(lane.walk, task.pixel, noVolumes());
}

/// Traces the lane's ray and begins the next one of the same segment, if there is one.
void traceOn(inout Lane lane) {
    traverse(lane.ray, lane.steps, 0xffffffffu);
    uint tried = 0u;
    lane.ray = nextRay(Owner(lane.slot), lane.walk, lane.ray, tried, lane.rays);
    lane.steps += 16u;  // of this pass, all loops but the traversal's and those of a constant bound
    if (!works(lane)) addToSums(lane.slot, lane.walk.radiance, lane.rays);
}

/// How many lanes without work may get some.
uint roomOf(Lane lane, Crew crew) {
    uint idle = countOf(isIdle(lane));
    uint busy = countOf(!isIdle(lane));
    return crew.othersWait ? min(idle, ENOUGH - min(busy, ENOUGH)) : idle;
}

/// What the ring holds, without the oldest segments where newer ones took their places.
uint heldOf(inout Crew crew, uint newest) {
    uint held = newest - crew.oldest;
    uint lost = held - min(held, ringSize());
    if (lost > 0u && subgroupElect()) atomicAdd(counters.segment_overflow, lost);
    crew.oldest += lost;
    return held - lost;
}

/// Lanes without work take the newest segments of the ring; returns how many are left there.
uint takeOwn(inout Lane lane, inout Crew crew) {
    uint newest = ringNewest[gl_SubgroupID];
    uint held = heldOf(crew, newest);
    bool idle = isIdle(lane);
    uint rank = rankAmong(idle);
    uint taken = crew.leaves ? 0u : min(roomOf(lane, crew), held);
    if (idle && rank < taken) beginSegment(lane, onRing(newest - 1u - rank));
    ringBarrier();
    if (subgroupElect()) ringNewest[gl_SubgroupID] = newest - taken;
    return held - taken;
}

/// The oldest segments of the ring go into the queue, `count` of them, at most one a lane.
void give(inout Crew crew, uint count) {
    bool gives = laneIndex < count;
    if (subgroupElect()) atomicAdd(sharedWords[LIVE], count);
    queueBarrier();
    while (countOf(gives) > 0u) {
        uint ticket = addOnce(QUEUED, countOf(gives)) + rankAmong(gives);
        if (gives) gives = !fill(ticket, onRing(crew.oldest + laneIndex));
        ringBarrier();
    }
    crew.oldest += count;
}

/// A subgroup without any work begins pixels, as many as it has lanes.
void beginPixels(inout Lane lane, inout Crew crew) {
    if (!crew.works) addOnce(LIVE, 1u);
    crew.works = true;
    queueBarrier();
    uint slot = addOnce(BEGUN, laneCount) + laneIndex;
    if (slot < frame.blocks.w) beginPixel(lane, slot);
    ringBarrier();
}

/// Lanes without work draw tickets, also for segments to come; where lanes are masked and waiting would keep others from working, only for those in the queue.
void drawTickets(inout Lane lane, Crew crew, int queued) {
    bool idle = isIdle(lane);
    uint there = min(countOf(idle), uint(max(queued, 0)));
    bool awaits = !MASKS_LANES && there == 0u && queued > -MOST_AWAITED;
    uint count = awaits ? min(countOf(idle), ENOUGH - min(countOf(!idle), ENOUGH)) : there;
    uint rank = rankAmong(idle);
    uint first = count > 0u ? addOnce(TICKETS, count) : 0u;
    if (idle && rank < count) lane.ticket = first + rank;
}

/// Lanes whose ticket's segment is there begin it; returns how many.
uint redeemTickets(inout Lane lane) {
    bool filled = lane.ticket != MINIRT_NONE && isFilled(lane.ticket);
    if (filled) {
        beginSegment(lane, take(lane.ticket));
        lane.ticket = MINIRT_NONE;
    }
    ringBarrier();
    return countOf(filled);
}

/// Gives up what counts in LIVE for segments that came from the queue, and for the subgroup where it has no work left.
void settle(inout Crew crew, uint received, bool works) {
    uint before = received + uint(crew.works);
    if (before != uint(works)) addOnce(LIVE, uint(works) - before);
    crew.works = works;
}

/// What lanes without work do meanwhile: nothing, for about a microsecond, so that others get at the memory.
void rest(inout Crew crew) {
    float x = float(crew.tries);
    if (!MASKS_LANES) {
        for (int i = 0; i < 100; i++) x = sin(x);  // of which a compiler cannot know that it is never 7
    }
    crew.tries += x == 7.0 ? 2u : 1u;
}

/// Segments that a subgroup with `held` on its ring gives away: as many as lanes wait for, and of very many as many as it has lanes.
uint surplusOf(uint held, int queued) {
    bool most = held >= min(KEPT, ringSize() / 4u) + laneCount && queued < MOST_QUEUED;
    uint wanted = most ? laneCount : uint(max(-queued, 0));
    return min(min(held, laneCount), wanted);
}

/// Shares work with other subgroups, which holds `held` segments itself.
void share(inout Lane lane, inout Crew crew, uint held) {
    int queued = int(lookAt(QUEUED) - lookAt(TICKETS));
    crew.othersWait = !MASKS_LANES && queued < 0;
    crew.allBegun = crew.allBegun || lookAt(BEGUN) >= frame.blocks.w;
    uint surplus = surplusOf(held, queued);
    if (surplus > 0u) give(crew, surplus);
    held -= surplus;
    if (held == 0u && !crew.leaves) {
        if (!crew.allBegun && countOf(!isIdle(lane)) == 0u) beginPixels(lane, crew);
        if (crew.allBegun) drawTickets(lane, crew, queued);
    }
    uint received = redeemTickets(lane);
    settle(crew, received, held > 0u || countOf(works(lane)) > 0u);
}

/// Whether a subgroup that has nothing to trace stays for what may come.
bool stays(Lane lane, inout Crew crew) {
    rest(crew);
    bool waits = countOf(lane.ticket != MINIRT_NONE) > 0u;
    bool mayCome = !crew.allBegun || (lookAt(LIVE) > 0u && (!MASKS_LANES || waits));
    return mayCome && crew.tries < MOST_TRIES;
}

/// Gives up the tickets of a subgroup that leaves; false where segments have come for some.
bool giveTicketsBack(inout Lane lane) {
    if (lane.ticket != MINIRT_NONE && giveBack(lane.ticket)) lane.ticket = MINIRT_NONE;
    ringBarrier();
    return countOf(lane.ticket != MINIRT_NONE) == 0u;
}

/// Goes on with the ring of the dispatch before, if there is one. False where all is done already.
bool enter(inout Crew crew) {
    countLanes();
    if (frame.sampling.w == 1u && lookAt(LIVE) == 0u && lookAt(BEGUN) >= frame.blocks.w) return false;
    uint left = ringStart() - MINIRT_SHARED_RING_WORDS;
    if (subgroupElect()) {
        if (frame.sampling.w == 0u) state[left] = state[left + 1u] = 0u;
        ringNewest[gl_SubgroupID] = state[left + 1u];
    }
    crew.oldest = frame.sampling.w == 0u ? 0u : state[left];
    crew.works = frame.sampling.w == 1u && state[left + 1u] != state[left];
    ringBarrier();
    return true;
}

/// Leaves the ring to the next dispatch.
void leave(Crew crew) {
    uint left = ringStart() - MINIRT_SHARED_RING_WORDS;
    if (subgroupElect()) {
        state[left] = crew.oldest;
        state[left + 1u] = ringNewest[gl_SubgroupID];
    }
}

/// All that a lane does, ray by ray, until nothing is left for its subgroup.
void work() {
    Segment none = Segment(vec3(0.0), vec3(0.0), vec3(0.0), 0u, 0u, noVolumes());
    TreeWalk walk = TreeWalk(PHASE_DONE, 0u, none, MINIRT_NONE, 0.0, 0u, vec3(0.0), noVolumes(), vec3(0.0));
    Lane lane = Lane(walk, noRay(), 0u, MINIRT_NONE, uvec2(0u), 0u);
    Crew crew = Crew(0u, false, false, false, false, 0u);
    bool goesOn = enter(crew);
    while (goesOn) {
        if (works(lane)) traceOn(lane);
        ringBarrier();
        crew.leaves = countOf(lane.steps > MOST_STEPS) > 0u;
        uint held = takeOwn(lane, crew);
        if (held > 0u || countOf(works(lane)) < laneCount) share(lane, crew, held);
        if (crew.works) crew.tries = 0u;
        bool traces = countOf(works(lane)) > 0u;
        if (!traces && (crew.leaves || (!crew.works && !stays(lane, crew)))) goesOn = !giveTicketsBack(lane);
        ringBarrier();
    }
    leave(crew);
}

/// When all is done, what was gathered for the pixels goes to the film.
void collect() {
    bool ended = sharedWords[LIVE] == 0u && sharedWords[BEGUN] >= frame.blocks.w;
    PixelTask task = taskOf(gl_GlobalInvocationID.x);
    if (!task.valid) return;
    if (ended) {
        sumsToFilm(task);
    } else {
        atomicAdd(counters.pending, 1u);
        if (frame.size.w != 0u) atomicAdd(counters.unfinished, 1u);
    }
}

void main() {
    if (frame.sampling.w == 2u)
        collect();
    else
        work();
}
