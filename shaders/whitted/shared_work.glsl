// Segments that lanes share. A subgroup holds those that its lanes leave on a ring of its own, and takes the newest; what is too much for it goes to a queue, for
// which lanes without work draw tickets. Who waits for a ticket's segment holds up nobody, and may stop waiting at any time. Radiance adds up in fixed point: a
// picture does not depend on who traced what.

layout(std430, binding = MINIRT_BINDING_STATE) coherent volatile buffer SharedBuffer { uint sharedWords[]; };

// Counters, each on a cache line of its own.
const uint QUEUED = 0u;    // segments that were put into the queue
const uint TICKETS = 32u;  // that were drawn
const uint BEGUN = 64u;    // slots of pixels
const uint LIVE = 96u;     // subgroups with work and segments in the queue: 0 when all is done

// Behind them: what became of each place of the queue, sums of the pixels, what is in the queue, rings. The host zeroes the first three for each dispatch.
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

// The ring of a subgroup: places are counted on and on.

shared uint ringNewest[64];  // one past the newest, of each subgroup of a block

uint ringSize() { return frame.size.z * gl_SubgroupSize; }

uint ringWord(uint place) {
    uint group = ringsStart() + gl_WorkGroupID.x * frame.size.z * gl_WorkGroupSize.x * uint(PACKED_WORDS);
    return group + gl_SubgroupID * ringSize() * uint(PACKED_WORDS) + place % ringSize();
}

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

// Sums of a pixel: of each channel whole numbers, then two fractions of 16 bits, in units of 2^-16 and 2^-32, which leaves room for 2^16 segments without
// carrying; then shadow rays, secondary ones, and whether the film has them.

uint sumWord(uint slot) { return SUMS + slot * MINIRT_SHARED_SUM_WORDS; }

void addWord(uint at, uint value) {
    if (value != 0u) atomicAdd(sharedWords[at], value);
}

void addFixed(uint at, float value) {
    float whole = floor(clamp(value, -1073741824.0, 1073741824.0));
    uint fraction = uint(min((value - whole) * 4294967296.0, 4294967040.0));
    addWord(at, uint(int(whole)));
    addWord(at + 1u, fraction >> 16);
    addWord(at + 2u, fraction & 0xffffu);
}

/// Moves what a lane has gathered for a pixel to its sums. A NaN counts and adds nothing.
void addToSums(uint slot, inout vec3 radiance, inout uvec2 rays) {
    uint at = sumWord(slot);
    if (hasNan(radiance)) {
        atomicAdd(counters.nan_pixels, 1u);
        radiance = vec3(0.0);
    }
    UNROLL for (int i = 0; i < 3; i++) addFixed(at + 3u * uint(i), radiance[i]);
    addWord(at + 9u, rays.x);
    addWord(at + 10u, rays.y);
    radiance = vec3(0.0);
    rays = uvec2(0u);
}

float fixedAt(uint at) {
    return float(int(sharedWords[at])) + (float(sharedWords[at + 1u]) + float(sharedWords[at + 2u]) * (1.0 / 65536.0)) * (1.0 / 65536.0);
}

/// Completes a sample of a pixel, of which all segments are done; once.
void sumsToFilm(PixelTask task) {
    uint at = sumWord(task.slot);
    if (sharedWords[at + 11u] != 0u) return;
    addToFilm(task.filmIndex, vec3(fixedAt(at), fixedAt(at + 3u), fixedAt(at + 6u)), true, uvec2(sharedWords[at + 9u], sharedWords[at + 10u]));
    sharedWords[at + 11u] = 1u;
}
