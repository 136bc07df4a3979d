// Segments that lanes share. A subgroup holds those that its lanes leave on a ring of its own, and takes the newest; what is too much for it goes to a queue, for
// which lanes without work draw tickets. Who waits for a ticket's segment holds up nobody, and may stop waiting at any time. Radiance adds up in fixed point: a
// picture does not depend on who traced what.

/// The pixel that a segment is for. Where it lies is found out for the few rays that need it, rather than kept.
struct Owner {
    uint slot;
};

uvec2 pixelOf(Owner owner) { return taskOf(owner.slot).pixel; }

/// All rays that leave a surface are for any lane, as soon as it is met.
const bool ALL_BRANCHES_WAIT = true;

layout(std430, binding = MINIRT_BINDING_STATE) coherent volatile buffer SharedBuffer { uint sharedWords[]; };

// Counters, each on a cache line of its own.
const uint QUEUED = 0u;    // segments that were put into the queue
const uint TICKETS = 32u;  // that were drawn
const uint BEGUN = 64u;    // slots of pixels
const uint LIVE = 96u;     // subgroups with work and segments in the queue: 0 when all is done

// Behind them: what became of each place of the queue, sums of the pixels, what is in the queue, rings. Counters, places and sums are zero when pixels begin.
const uint PLACES = MINIRT_SHARED_COUNTER_WORDS;
const uint SUMS = PLACES + MINIRT_SHARED_QUEUE;
uint queueStart() { return SUMS + frame.blocks.w * MINIRT_SHARED_SUM_WORDS; }
uint ringsStart() { return queueStart() + MINIRT_SHARED_QUEUE * MINIRT_SHARED_SEGMENT_WORDS(SAVED_VOLUMES); }

const int PACKED_WORDS = int(MINIRT_SHARED_SEGMENT_WORDS(SAVED_VOLUMES));

struct PackedSegment {
    uint word[PACKED_WORDS];
};

PackedSegment pack(Segment segment, uint slot) {
    PackedSegment packed;
    UNROLL for (int i = 0; i < 3; i++) {
        packed.word[i] = floatBitsToUint(segment.origin[i]);
        packed.word[3 + i] = floatBitsToUint(segment.direction[i]);
        packed.word[6 + i] = floatBitsToUint(segment.throughput[i]);
    }
    packed.word[9] = packDepth(segment.depth, segment.channel);
    packed.word[10] = slot;
    UNROLL for (int i = 0; i < int(SAVED_VOLUMES); i++) packed.word[11 + i] = segment.volumes.entry[i];
    return packed;
}

Segment unpack(PackedSegment packed, out uint slot) {
    Segment segment;
    UNROLL for (int i = 0; i < 3; i++) {
        segment.origin[i] = uintBitsToFloat(packed.word[i]);
        segment.direction[i] = uintBitsToFloat(packed.word[3 + i]);
        segment.throughput[i] = uintBitsToFloat(packed.word[6 + i]);
    }
    segment.depth = depthIn(packed.word[9]);
    segment.channel = channelIn(packed.word[9]);
    slot = packed.word[10];
    segment.volumes = noVolumes();
    UNROLL for (int i = 0; i < int(SAVED_VOLUMES); i++) segment.volumes.entry[i] = packed.word[11 + i];
    return segment;
}

// How many lanes a subgroup has, which need not be gl_SubgroupSize, and which of them this one is.
uint laneCount, laneIndex;

void countLanes() {
    laneCount = subgroupBallotBitCount(subgroupBallot(true));
    laneIndex = subgroupBallotExclusiveBitCount(subgroupBallot(true));
}

// The ring of a subgroup: places are counted on and on.

shared uint ringNewest[64];  // one past the newest, of each subgroup of a block

uint ringSize() { return frame.size.z * gl_WorkGroupSize.x / gl_NumSubgroups; }

/// The first word of the ring; in front of it lie the two that a subgroup leaves to the next dispatch: its oldest place, and one past the newest.
uint ringStart() {
    uint ring = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID;
    return ringsStart() + ring * ringSize() * uint(PACKED_WORDS) + (ring + 1u) * MINIRT_SHARED_RING_WORDS;
}

uint ringWord(uint place) { return ringStart() + place % ringSize(); }

PackedSegment onRing(uint place) {
    PackedSegment packed;
    UNROLL for (int i = 0; i < PACKED_WORDS; i++) packed.word[i] = state[ringWord(place) + uint(i) * ringSize()];
    return packed;
}

bool hold(uint slot, inout TreeWalk walk, Segment segment) {
    uint at = ringWord(atomicAdd(ringNewest[gl_SubgroupID], 1u));
    PackedSegment packed = pack(segment, slot);
    UNROLL for (int i = 0; i < PACKED_WORDS; i++) state[at + uint(i) * ringSize()] = packed.word[i];
    return true;
}

// Where lanes are masked, those of a subgroup work in step, memory is seen in order, and a driver (Mesa 22) ends all subgroups of a group with the first
// that has passed its last barrier of memory: there are none there.

/// Before lanes read what others of their subgroup have put on the ring, and before these change it again.
void ringBarrier() {
    if (MASKS_LANES) return;
    subgroupMemoryBarrierBuffer();
    subgroupMemoryBarrierShared();
    subgroupBarrier();
}

/// Between words that other subgroups must see change in this order.
void queueBarrier() {
    if (!MASKS_LANES) memoryBarrierBuffer();
}

// The queue. A place holds segments 32 apart, so that neighbours' words are contiguous.

uint queueWord(uint ticket) {
    uint place = ticket % MINIRT_SHARED_QUEUE;
    return queueStart() + place / 32u * 32u * uint(PACKED_WORDS) + place % 32u;
}

// A place's word: twice the round in which it was filled, one less where nobody waits for that any longer.
uint filledWord(uint ticket) { return 2u * (ticket / MINIRT_SHARED_QUEUE + 1u); }

bool isFilled(uint ticket) { return sharedWords[PLACES + ticket % MINIRT_SHARED_QUEUE] == filledWord(ticket); }

/// Whether somebody has the ticket or may still draw it; otherwise the segment needs another place.
bool fill(uint ticket, PackedSegment packed) {
    UNROLL for (int i = 0; i < PACKED_WORDS; i++) sharedWords[queueWord(ticket) + uint(i) * 32u] = packed.word[i];
    queueBarrier();
    return atomicExchange(sharedWords[PLACES + ticket % MINIRT_SHARED_QUEUE], filledWord(ticket)) != filledWord(ticket) - 1u;
}

/// Gives a ticket back; false where its segment has come.
bool giveBack(uint ticket) {
    uint now = sharedWords[PLACES + ticket % MINIRT_SHARED_QUEUE];
    return now != filledWord(ticket) && atomicCompSwap(sharedWords[PLACES + ticket % MINIRT_SHARED_QUEUE], now, filledWord(ticket) - 1u) == now;
}

PackedSegment take(uint ticket) {
    queueBarrier();
    PackedSegment packed;
    UNROLL for (int i = 0; i < PACKED_WORDS; i++) packed.word[i] = sharedWords[queueWord(ticket) + uint(i) * 32u];
    return packed;
}

// Sums of a pixel: of each channel a fraction in units of 2^-32, a whole number and 2^32 of it; shadow rays, secondary ones, flags.

const uint HAS_NAN = 1u;
const uint IS_ON_FILM = 2u;

uint sumWord(uint slot) { return SUMS + slot * MINIRT_SHARED_SUM_WORDS; }

/// Adds to a digit; returns what carries to the next one.
uint addDigit(uint at, uint value) {
    if (value == 0u) return 0u;
    uint before = atomicAdd(sharedWords[at], value);
    return before + value < before ? 1u : 0u;
}

void addFixed(uint at, float value) {
    float whole = floor(clamp(value, -4611686018427387904.0, 4611686018427387904.0));
    float fraction = value == whole ? 0.0 : value - whole;
    bool isLarge = abs(whole) >= 2147483648.0;
    int high = isLarge ? int(floor(whole / 4294967296.0)) : int(whole) >> 31;
    uint low = isLarge ? uint(whole - float(high) * 4294967296.0) : uint(int(whole));
    uint carry = addDigit(at, uint(min(fraction * 4294967296.0, 4294967040.0)));
    uint carries = addDigit(at + 1u, low) + addDigit(at + 1u, carry);
    addDigit(at + 2u, uint(high) + carries);
}

float fixedAt(uint at) {
    int low = int(sharedWords[at + 1u]), high = int(sharedWords[at + 2u]);
    float whole = high == low >> 31 ? float(low) : float(high) * 4294967296.0 + float(sharedWords[at + 1u]);
    return whole + float(sharedWords[at]) * (1.0 / 4294967296.0);
}

/// Moves what a lane has gathered for a pixel to its sums.
void addToSums(uint slot, inout vec3 radiance, inout uvec2 rays) {
    uint at = sumWord(slot);
    if (hasNan(radiance))
        atomicOr(sharedWords[at + 11u], HAS_NAN);
    else
        UNROLL for (int i = 0; i < 3; i++) addFixed(at + 3u * uint(i), radiance[i]);
    addDigit(at + 9u, rays.x);
    addDigit(at + 10u, rays.y);
    radiance = vec3(0.0);
    rays = uvec2(0u);
}

/// Completes a sample of a pixel, of which all segments are done; once.
void sumsToFilm(PixelTask task) {
    uint at = sumWord(task.slot);
    uint flags = sharedWords[at + 11u];
    if ((flags & IS_ON_FILM) != 0u) return;
    float nan = uintBitsToFloat(0x7fc00000u);
    vec3 radiance = (flags & HAS_NAN) != 0u ? vec3(nan) : vec3(fixedAt(at), fixedAt(at + 3u), fixedAt(at + 6u));
    addToFilm(task.filmIndex, radiance, true, uvec2(sharedWords[at + 9u], sharedWords[at + 10u]));
    sharedWords[at + 11u] = IS_ON_FILM;
}
