// Which volumes a ray is in, and what it meets at the surface of one. GLSL and C++ (tests/shader_source.hpp); VOLUME_CAPACITY is defined
// by whoever includes the file.
//
// Media are numbers: 0 surrounds the scene, v + 1 fills volume v. Two methods share the types:
// *ordered*: of the volumes that a ray is in, the one with the highest number is there; the same in both directions.
// *parity*: the stack of Waechter and Raab (Ray Tracing Gems, ch. 11): of two overlapping surfaces, the second that a ray meets counts.

/// The volumes that a ray is in, 4 bytes each; 0 is a free entry, and free at first.
/// Ordered: a set; an entry is medium << 8 | 128 + how often the ray is inside. Parity: a stack; an entry is a medium, the last one is
/// where the ray is.
struct VolumeList {
    uint entry[VOLUME_CAPACITY];
};

/// What a ray meets at the surface of a volume.
struct Crossing {
    uint from;  // medium on the ray's side
    uint to;    // medium behind; equal to `from`: the surface is hidden in another volume, and the ray passes as if it were not there
    bool overflow;  // the list was full: the surface is passed over
    VolumeList reflected;    // volumes of a ray that goes back
    VolumeList transmitted;  // volumes of a ray that goes on
};

/// Ordered: the medium that a ray is in.
uint orderedMedium(VolumeList list) {
    uint highest = 0u;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) {
        bool inside = (list.entry[i] & 255u) > 128u;
        highest = inside ? max(highest, list.entry[i] >> 8u) : highest;
    }
    return highest;
}

/// Ordered: the list with the entry at `place` counting `count` times inside of `medium`.
VolumeList withCount(VolumeList list, int place, uint medium, int count) {
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) {
        uint entry = count == 0 ? 0u : (medium << 8u | uint(128 + count));
        list.entry[i] = i == place ? entry : list.entry[i];
    }
    return list;
}

/// Ordered: a ray meets the surface of the volume filled by `medium` from outside (`entering`) or from inside.
/// `counted`: the volume may overlap itself, so that being inside must be counted. Otherwise the side that the ray comes from says whether it is
/// inside: what rounding made a ray miss is forgotten at the next surface.
Crossing crossOrdered(VolumeList list, uint medium, bool entering, bool counted) {
    int place = VOLUME_CAPACITY;  // of the volume's entry, else of a free one
    UNROLL for (int i = VOLUME_CAPACITY - 1; i >= 0; i--) place = list.entry[i] == 0u ? i : place;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) place = list.entry[i] >> 8u == medium ? i : place;
    int stored = 0;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++)
        stored = i == place && list.entry[i] != 0u ? int(list.entry[i] & 255u) - 128 : stored;
    int before = counted ? stored : (entering ? 0 : 1);
    int after = clamp(before + (entering ? 1 : -1), -127, 127);
    Crossing crossing;
    crossing.overflow = place == VOLUME_CAPACITY;
    crossing.reflected = withCount(list, place, medium, before);
    crossing.transmitted = withCount(list, place, medium, after);
    crossing.from = orderedMedium(crossing.reflected);
    crossing.to = orderedMedium(crossing.transmitted);
    return crossing;
}

/// Parity: the medium that a ray is in.
uint stackedMedium(VolumeList list) {
    uint top = 0u;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) top = list.entry[i] != 0u ? list.entry[i] : top;
    return top;
}

/// Parity: the stack without the entry at `place`, closed up.
VolumeList withoutEntry(VolumeList list, int place) {
    VolumeList shorter = list;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY - 1; i++) shorter.entry[i] = i < place ? list.entry[i] : list.entry[i + 1];
    shorter.entry[VOLUME_CAPACITY - 1] = place < VOLUME_CAPACITY ? 0u : list.entry[VOLUME_CAPACITY - 1];
    return shorter;
}

/// Parity: a ray meets the surface of the volume filled by `medium`; the stack knows whether it enters.
/// The book keeps two flags an entry, `topmost` and `odd`. They are needed only while a leaving ray's second entry is on the stack, and that one
/// is never stored here: each volume has at most one entry, which is topmost and odd.
Crossing crossStacked(VolumeList list, uint medium) {
    int depth = 0;
    int previous = VOLUME_CAPACITY;  // the volume's own entry
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) {
        depth += list.entry[i] != 0u ? 1 : 0;
        previous = list.entry[i] == medium ? i : previous;
    }
    VolumeList others = withoutEntry(list, previous);
    uint below = stackedMedium(others);
    bool entering = previous == VOLUME_CAPACITY;
    bool hidden = !entering && previous < depth - 1;  // another volume was entered since: its medium is on both sides
    Crossing crossing;
    crossing.overflow = entering && depth == VOLUME_CAPACITY;
    crossing.from = entering || hidden ? below : medium;
    crossing.to = entering && !crossing.overflow ? medium : below;
    crossing.reflected = list;
    crossing.transmitted = others;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++)
        crossing.transmitted.entry[i] = entering && i == depth ? medium : crossing.transmitted.entry[i];
    return crossing;
}
