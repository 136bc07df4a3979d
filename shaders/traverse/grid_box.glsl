// The test of box.glsl where planes are 16-bit numbers, two to a word, by the fewest instructions on units that an H100 has few of (docs/performance.md).
// GLSL and C++ (tests/shader_source.hpp).

/// A ray against such boxes. Of a word times `entry` the upper half is the plane where the ray enters, of one times `exit` the other plane.
struct GridRay {
    vec3 scale;  // these three as a SlabRay has them, but
    vec3 near;
    vec3 far;  // for numbers with PLANE_BIAS added
    uvec3 entry;
    uvec3 exit;
};

/// 2^23: a float of that size has room for a plane in its lowest bits. Put there by an `or`, it needs no conversion.
const float PLANE_BIAS = 8388608.0;
const uint PLANE_BIAS_BITS = 0x4b000000u;

/// `slabs` for such boxes. The bias rounds `far` by half a plane (2^23 times scale, times 2^-24), and as much a product that is not fused with its sum: `far` is
/// put off by a little more than both. Finite for scenes up to 1.3e18. Planes where the ray enters are converted, which is exact: units for conversions stand idle else.
GridRay gridRay(SlabRay slabs) {
    GridRay ray;
    ray.scale = slabs.scale;
    ray.near = slabs.near;
    ray.far = (slabs.far + abs(slabs.scale) * 1.0625f) - slabs.scale * PLANE_BIAS;
    ray.entry = uvec3(slabs.scale.x < 0.0f ? 1u : 0x10000u, slabs.scale.y < 0.0f ? 1u : 0x10000u, slabs.scale.z < 0.0f ? 1u : 0x10000u);
    ray.exit = 0x10001u - ray.entry;
    return ray;
}

/// A product picks a plane, as shifts and selections share their units with all comparisons.
float entryPlane(uint planes, uint factor) { return float(planes * factor >> 16); }
float exitPlane(uint planes, uint factor) { return uintBitsToFloat(planes * factor >> 16 | PLANE_BIAS_BITS); }

/// `planes`, an axis a word: number of the low plane in the lower half, of the high plane in the upper one.
BoxHit intersectGridBox(GridRay ray, uvec3 planes, float tMax) {
    vec3 entry = vec3(entryPlane(planes.x, ray.entry.x), entryPlane(planes.y, ray.entry.y), entryPlane(planes.z, ray.entry.z));
    vec3 exit = vec3(exitPlane(planes.x, ray.exit.x), exitPlane(planes.y, ray.exit.y), exitPlane(planes.z, ray.exit.z));
    return overlap(entry * ray.scale + ray.near, exit * ray.scale + ray.far, tMax);
}
