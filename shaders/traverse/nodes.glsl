// Fetching a node's two child boxes. Two layouts; the compiler picks one for the scene (effect `float_nodes`).
// A reference has MINIRT_LEAF set for a leaf: (first slot << 3 | count - 1).

struct ChildBoxes {
    vec3 lo0, hi0, lo1, hi1;  // plane numbers of SlabRay
    uint ref0, ref1;
};

/// 64 bytes: planes as floats.
ChildBoxes fetchWideNode(uint node) {
    uint row = node * 4u;
    uvec4 a = nodeRow(row);
    uvec4 b = nodeRow(row + 1u);
    uvec4 c = nodeRow(row + 2u);
    uvec4 d = nodeRow(row + 3u);
    return ChildBoxes(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz), a.w, c.w);
}

#ifdef EFFECT_FLOAT_NODES

/// Planes are coordinates in metres.
ChildBoxes fetchNode(uint node) { return fetchWideNode(node); }

#else

/// The host has unpacked the nodes: a GPU spends more on their 16-bit numbers than on fetching twice as much.
layout(constant_id = MINIRT_SPEC_WIDE_NODES) const bool WIDE_NODES = false;

float low16(uint word) { return float(int(word & 0xffffu)); }
float high16(uint word) { return float(int(word >> 16)); }

/// 32 bytes: twelve 16-bit planes of one grid over the scene.
ChildBoxes fetchNode(uint node) {
    if (WIDE_NODES) return fetchWideNode(node);
    uint row = node * 2u;
    uvec4 a = nodeRow(row);
    uvec4 b = nodeRow(row + 1u);
    return ChildBoxes(vec3(low16(a.x), high16(a.x), low16(a.y)), vec3(high16(a.y), low16(a.z), high16(a.z)),
                      vec3(low16(b.x), high16(b.x), low16(b.y)), vec3(high16(b.y), low16(b.z), high16(b.z)), a.w, b.w);
}

#endif
