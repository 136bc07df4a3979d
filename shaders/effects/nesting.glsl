// Effects `nesting`, `parity`, `self_overlap`: rays that know which volumes they are in. Identity: volumes do not touch, so the side that a
// ray comes from says it all.

/// What a ray meets at a surface.
struct Boundary {
    bool isVolume;  // of a volume; otherwise both media are the one in front
    bool skipped;   // hidden in another volume: the ray goes straight on
    bool overflow;  // skipped because the list is full
    uint from;      // medium that the ray comes through
    uint to;        // medium behind
    VolumeList reflected;    // volumes of rays that stay in front
    VolumeList transmitted;  // volumes of rays that go through
};

uint materialOf(uint slot) { return floatBitsToUint(primitiveRow(slot, 0u).w) & ~MINIRT_PRIMITIVE_SPHERE; }
uint bodyOf(uint slot) { return floatBitsToUint(primitiveRow(slot, 1u).w); }

VolumeList noVolumes() {
    VolumeList list;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) list.entry[i] = 0u;
    return list;
}

#ifdef EFFECT_NESTING

const bool TRACKS_VOLUMES = true;
const uint SAVED_VOLUMES = uint(VOLUME_CAPACITY);

uint mediumAround(VolumeList list) {
#ifdef EFFECT_PARITY
    return stackedMedium(list);
#else
    return orderedMedium(list);
#endif
}

Crossing crossVolume(VolumeList list, uint medium, bool entering) {
#if defined(EFFECT_PARITY)
    return crossStacked(list, medium);
#elif defined(EFFECT_SELF_OVERLAP)
    return crossOrdered(list, medium, entering, true);
#else
    return crossOrdered(list, medium, entering, false);
#endif
}

/// `body` is met from outside (`entering`) or inside by a ray in `list`.
Boundary boundaryAt(VolumeList list, uint body, bool entering) {
    bool isVolume = body < scene.counts.z;
    Crossing crossing = crossVolume(list, body + 1u, entering);
    uint around = mediumAround(list);
    return Boundary(isVolume, isVolume && crossing.from == crossing.to, isVolume && crossing.overflow, isVolume ? crossing.from : around,
                    isVolume ? crossing.to : around, isVolume ? crossing.reflected : list, isVolume ? crossing.transmitted : list);
}

void putVolumes(uint slot, inout uint word, VolumeList list) {
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) putWord(slot, word, list.entry[i]);
}

VolumeList takeVolumes(uint slot, inout uint word) {
    VolumeList list;
    UNROLL for (int i = 0; i < VOLUME_CAPACITY; i++) list.entry[i] = takeWord(slot, word);
    return list;
}

#else

const bool TRACKS_VOLUMES = false;
const uint SAVED_VOLUMES = 0u;

uint mediumAround(VolumeList list) { return 0u; }

Boundary boundaryAt(VolumeList list, uint body, bool entering) {
    bool isVolume = body < scene.counts.z;
    uint inside = isVolume ? body + 1u : 0u;
    return Boundary(isVolume, false, false, entering ? 0u : inside, entering ? inside : 0u, list, list);
}

void putVolumes(uint slot, inout uint word, VolumeList list) {}
VolumeList takeVolumes(uint slot, inout uint word) { return noVolumes(); }

#endif
