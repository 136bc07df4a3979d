// Floating-point care that every kernel shares. GLSL and C++ (tests/shader_source.hpp).

/// Bound of the relative error of n chained roundings (Higham 2002, section 3.1; pbrt-v4 section 6.8).
real errorGamma(int n) {
    real e = real(n) * MACHINE_EPSILON;
    return e / (real(1) - e);
}

/// Largest component.
real maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }

/// `v` scaled to unit length, also where the squares of its components would underflow or overflow; zero stays zero.
vec3 unitVector(vec3 v) {
    real size = maxComponent(abs(v));
    return size > real(0) ? normalize(v / size) : v;
}

/// `value` moved to the next representable number in the direction of the sign of `direction`; unchanged where that is 0.
real roundAway(real value, real direction) {
    bool up = direction > real(0);
    real next = nextUp(up ? value : -value);
    return direction == real(0) ? value : up ? next : -next;
}

/// A point on a surface, known up to rounding.
struct SurfacePoint {
    vec3 p;
    vec3 pError;  // bound of the absolute error of p
    vec3 ng;      // unit geometric normal, outward
};

/// Origin of a ray that leaves a SurfacePoint on the side of `w`: outside of the box of errors around p, so it cannot meet the
/// surface again, and no farther (pbrt-v4 section 6.8.6).
vec3 offsetRayOrigin(vec3 p, vec3 pError, vec3 ng, vec3 w) {
    vec3 offset = ng * dot(abs(ng), pError);
    if (dot(w, ng) < real(0)) offset = -offset;
    vec3 moved = p + offset;
    return vec3(roundAway(moved.x, offset.x), roundAway(moved.y, offset.y), roundAway(moved.z, offset.z));
}

/// atan(y / x) over all four quadrants, in radians, to 3e-7 (one rounding near pi), alike on every device; 0 at the origin.
real atan2Portable(real y, real x) {
    real ax = abs(x);
    real ay = abs(y);
    real longer = max(ax, ay);
    real q = longer > real(0) ? min(ax, ay) / longer : real(0);
    real s = q * q;
    // Odd polynomial by interpolation at the Chebyshev nodes of q^2 in [0,1]; its own error is 1e-8.
    real a = real(0.0027662835);
    a = a * s + real(-0.0157312491);
    a = a * s + real(0.0421376236);
    a = a * s + real(-0.0745685483);
    a = a * s + real(0.106183706);
    a = a * s + real(-0.141977978);
    a = a * s + real(0.19991872);
    a = a * s + real(-0.333330367);
    a = a * s + real(0.999999982);
    a = a * q;
    if (ay > ax) a = real(HALF_PI) - a;
    if (x < real(0)) a = real(PI) - a;
    return y < real(0) ? -a : a;
}

/// Texture coordinates in [0,1]^2 of a unit direction in an equirectangular panorama: +Y at the top row, -Z at u = 1/4.
/// `turns` rotates the panorama about +Y. No acos: full precision at the poles.
vec2 equirectUv(vec3 direction, real turns) {
    real u = atan2Portable(direction.z, direction.x) * real(INV_TWO_PI) + real(0.5) + turns;
    real horizontal = sqrt(direction.x * direction.x + direction.z * direction.z);
    real v = atan2Portable(horizontal, direction.y) * real(INV_PI);
    return vec2(u - floor(u), v);
}
