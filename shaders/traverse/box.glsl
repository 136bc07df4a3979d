// Conservative ray-box test against planes on a grid. GLSL and C++ (tests/shader_source.hpp).

/// Per ray and axis: t = plane * scale + near (or far). `near` and `far` differ by twice the bound of all rounding errors of that
/// line for planes in 0..planes, so a box is never missed by rounding, whatever the ray (the aim of Ize 2013, without a cost a box).
struct SlabRay {
    vec3 scale;
    vec3 near;
    vec3 far;
};

/// `gridOrigin`, `gridScale`: position of plane 0 and distance of planes; `planes`: the largest plane number in use.
/// Finite for axis-parallel rays: components of the direction below 1e-18 count as 1e-18.
SlabRay slabRay(vec3 origin, vec3 direction, vec3 gridOrigin, vec3 gridScale, vec3 planes) {
    vec3 tiny = vec3(real(1e-18));
    vec3 size = max(abs(direction), tiny);
    vec3 inverse = vec3(direction.x < real(0) ? -real(1) / size.x : real(1) / size.x,
                        direction.y < real(0) ? -real(1) / size.y : real(1) / size.y,
                        direction.z < real(0) ? -real(1) / size.z : real(1) / size.z);
    SlabRay slabs;
    slabs.scale = gridScale * inverse;
    vec3 middle = (gridOrigin - origin) * inverse;
    // Each term is off by at most a few units in its last place; 16 covers them and the triangle test's own rounding.
    vec3 slack = (abs(slabs.scale) * planes + abs(middle)) * (real(16) * MACHINE_EPSILON);
    slabs.near = middle - slack;
    slabs.far = middle + slack;
    return slabs;
}

/// Entry distance (at least 0) and whether the box is met before tMax. All distances are finite where coordinates of the scene are below 1e18, as those of
/// minirtc's are, and of the origin below 1e19, beyond which the triangle test overflows; a negative exit is a miss whichever it is.
struct BoxHit {
    bool hit;
    real tNear;
};

/// Of the intervals between the distances where planes are entered and left, an axis each, and of 0 to tMax. Extremes by their bits: the fewest
/// instructions, where drivers guard min and max against NaN above all.
BoxHit overlap(vec3 tEntry, vec3 tExit, real tMax) {
    BoxHit result;
    result.tNear = maxByBits(maxByBits(tEntry.x, tEntry.y), maxByBits(tEntry.z, real(0)));
    result.hit = result.tNear <= minByBits(minByBits(tExit.x, tExit.y), minByBits(tExit.z, tMax));
    return result;
}

/// Planes are picked by the direction's signs.
BoxHit intersectBox(SlabRay slabs, vec3 lo, vec3 hi, real tMax) {
    vec3 entry = vec3(slabs.scale.x < real(0) ? hi.x : lo.x, slabs.scale.y < real(0) ? hi.y : lo.y, slabs.scale.z < real(0) ? hi.z : lo.z);
    vec3 exit = vec3(slabs.scale.x < real(0) ? lo.x : hi.x, slabs.scale.y < real(0) ? lo.y : hi.y, slabs.scale.z < real(0) ? lo.z : hi.z);
    return overlap(entry * slabs.scale + slabs.near, exit * slabs.scale + slabs.far, tMax);
}
