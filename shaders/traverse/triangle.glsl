// Watertight ray-triangle intersection (Woop, Benthin, Wald 2013). GLSL and C++ (tests/shader_source.hpp).

/// A ray's direction as a shear that maps it onto the axis where it is longest.
struct Shear {
    vec3 scale;  // x/z, y/z, 1/z of the permuted direction
    int axis;    // 0, 1, 2: that axis becomes z
};

/// `axis` last, the cyclic order kept.
vec3 permute(vec3 v, int axis) {
    if (axis == 0) return vec3(v.y, v.z, v.x);
    if (axis == 1) return vec3(v.z, v.x, v.y);
    return v;
}

Shear shearOf(vec3 direction) {
    vec3 a = abs(direction);
    Shear shear;
    shear.axis = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    vec3 d = permute(direction, shear.axis);
    shear.scale = vec3(d.x / d.z, d.y / d.z, real(1) / d.z);
    return shear;
}

struct TriangleHit {
    bool hit;
    real t;
    real b1;  // barycentric weights of the second and third vertex
    real b2;
};

/// Bound of the error of a hit's depth, its coordinate on the longest axis. Hits nearer than it may lie behind the origin (after pbrt-v4
/// section 6.8.7). `a`, `b`, `c`: sheared vertices. Their rounding moves the triangle's plane: the depth follows by the plane's slopes.
/// The rounding of the edge functions moves the point within the plane: the depth follows by a share of the triangle's range of depths.
/// Being a mean of the vertices' depths it never leaves that range, so that small, thin and grazed triangles far away keep their hits.
real triangleErrorOfDepth(vec3 a, vec3 b, vec3 c, real inverseDeterminant) {
    vec3 size = max(abs(a), max(abs(b), abs(c)));
    real range = max(a.z, max(b.z, c.z)) - min(a.z, min(b.z, c.z));
    vec3 slopes = abs(cross(b - a, c - a) * inverseDeterminant);
    real tilted = errorGamma(4) * ((size.x + size.z) * slopes.x + (size.y + size.z) * slopes.y);
    real shifted = real(6) * errorGamma(2) * size.x * size.y * abs(inverseDeterminant) * range;
    return errorGamma(10) * size.z + min(tilted + shifted, range);
}

/// Intersects the line of the ray with the triangle v0 v1 v2, for hits with 0 < t < tMax, t beyond its own error. Two triangles that share an edge leave no gap between
/// them: the edge functions are evaluated alike on both sides, without contraction. A line in the triangle's plane misses.
TriangleHit intersectTriangle(vec3 origin, Shear shear, vec3 v0, vec3 v1, vec3 v2, real tMax) {
    vec3 a = permute(v0 - origin, shear.axis);
    vec3 b = permute(v1 - origin, shear.axis);
    vec3 c = permute(v2 - origin, shear.axis);
    PRECISE real ax = a.x - shear.scale.x * a.z;
    PRECISE real ay = a.y - shear.scale.y * a.z;
    PRECISE real bx = b.x - shear.scale.x * b.z;
    PRECISE real by = b.y - shear.scale.y * b.z;
    PRECISE real cx = c.x - shear.scale.x * c.z;
    PRECISE real cy = c.y - shear.scale.y * c.z;
    PRECISE real e0 = cx * by - cy * bx;
    PRECISE real e1 = ax * cy - ay * cx;
    PRECISE real e2 = bx * ay - by * ax;
    real determinant = e0 + e1 + e2;
    real inverse = real(1) / determinant;
    TriangleHit hit;
    real az = a.z * shear.scale.z;
    real bz = b.z * shear.scale.z;
    real cz = c.z * shear.scale.z;
    hit.t = (e0 * az + e1 * bz + e2 * cz) * inverse;
    hit.b1 = e1 * inverse;
    hit.b2 = e2 * inverse;
    real least = min(e0, min(e1, e2));
    real greatest = max(e0, max(e1, e2));
    real error = triangleErrorOfDepth(vec3(ax, ay, a.z), vec3(bx, by, b.z), vec3(cx, cy, c.z), inverse) * abs(shear.scale.z);
    hit.hit = (least >= real(0) || greatest <= real(0)) && determinant != real(0) && hit.t > error && hit.t < tMax;
    return hit;
}

/// The point of a hit, from its barycentrics (pbrt-v4 section 6.8.5).
SurfacePoint trianglePoint(TriangleHit hit, vec3 v0, vec3 v1, vec3 v2) {
    vec3 p0 = (real(1) - hit.b1 - hit.b2) * v0;
    vec3 p1 = hit.b1 * v1;
    vec3 p2 = hit.b2 * v2;
    SurfacePoint point;
    point.p = p0 + p1 + p2;
    point.pError = errorGamma(7) * (abs(p0) + abs(p1) + abs(p2));
    point.ng = unitVector(cross(v1 - v0, v2 - v0));
    return point;
}
