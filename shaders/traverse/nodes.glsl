// Fetching a node's two child boxes, and the rays that meet them. Two layouts; the compiler picks one for the scene (effect `float_nodes`).
// A reference has MINIRT_LEAF set for a leaf: (first slot << 3 | count - 1).

#ifdef EFFECT_FLOAT_NODES

#define BoxRay SlabRay

struct Box {
    vec3 lo, hi;  // metres
};

BoxRay boxRayOf(SlabRay slabs) { return slabs; }
BoxHit meetBox(BoxRay ray, Box box, float tMax) { return intersectBox(ray, box.lo, box.hi, tMax); }

#else

#define BoxRay GridRay

struct Box {
    uvec3 planes;  // of one grid over the scene, see intersectGridBox
};

BoxRay boxRayOf(SlabRay slabs) { return gridRay(slabs); }
BoxHit meetBox(BoxRay ray, Box box, float tMax) { return intersectGridBox(ray, box.planes, tMax); }

#endif

struct Children {
    Box box0, box1;
    uint ref0, ref1;
};

#ifdef EFFECT_FLOAT_NODES

/// 64 bytes.
Children fetchNode(uint node) {
    uint row = node * 4u;
    uvec4 a = nodeRow(row);
    uvec4 b = nodeRow(row + 1u);
    uvec4 c = nodeRow(row + 2u);
    uvec4 d = nodeRow(row + 3u);
    return Children(Box(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz)), Box(uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz)), a.w, c.w);
}

#else

/// 32 bytes.
Children fetchNode(uint node) {
    uint row = node * 2u;
    uvec4 a = nodeRow(row);
    uvec4 b = nodeRow(row + 1u);
    return Children(Box(a.xyz), Box(b.xyz), a.w, b.w);
}

#endif
