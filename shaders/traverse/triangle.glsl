// Watertight ray-triangle intersection (Woop, Benthin, Wald 2013). GLSL and C++ (tests/shader_source.hpp).

/// A ray's direction, and the shear that maps it onto the axis where it is longest.
struct Shear {
    vec3 direction;
    vec3 scale;  // x/z, y/z, 1/z of the permuted direction
    int axis;    // 0, 1, 2: that axis becomes z
};

/// `axis` last, by exchanging it with z: a selection less an axis than a rotation. Mirroring turns all edge functions' signs over, which changes no hit.
vec3 permute(vec3 v, int axis) {
    return vec3(axis == 0 ? v.z : v.x, axis == 1 ? v.z : v.y, axis == 0 ? v.x : axis == 1 ? v.y : v.z);
}

Shear shearOf(vec3 direction) {
    vec3 a = abs(direction);
    Shear shear;
    shear.direction = direction;
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

/// Where a line meets the plane of a triangle, as far as rounding lets it be known.
struct PlaneHit {
    bool steep;  // the line is not parallel to the plane within rounding; else the rest is undefined
    bool ahead;  // the plane is before the origin, and farther away than rounding reaches
    real t;
};

/// `toVertex`: from the origin to a vertex, `u` and `v`: the edges from there. A sign counts only beyond the bound of its error:
/// rounding has at most 4 steps in a component of n and 4 more in a product with it, all relative to the terms of the cross product.
PlaneHit intersectPlane(vec3 direction, vec3 toVertex, vec3 u, vec3 v) {
    vec3 n = cross(u, v);
    vec3 x = abs(u);
    vec3 y = abs(v);
    vec3 error = errorGamma(8) * vec3(x.y * y.z + x.z * y.y, x.z * y.x + x.x * y.z, x.x * y.y + x.y * y.x);
    real height = dot(n, toVertex);
    real slope = dot(n, direction);
    PlaneHit hit;
    hit.steep = abs(slope) > dot(error, abs(direction));
    hit.ahead = abs(height) > dot(error, abs(toVertex)) && (height > real(0)) == (slope > real(0));
    hit.t = height / slope;
    return hit;
}

/// Intersects the line of the ray, whose direction is of unit length, with the triangle v0 v1 v2, for hits with 0 < t < tMax. Two
/// triangles that share an edge leave no gap between them: the edge functions are evaluated alike on both sides, without contraction.
/// A hit whose t could be negative but for rounding is a miss, so a ray that starts beside a triangle does not find it again; the
/// plane decides this, as it is ten times more certain of the side than a mean of the vertices' depths. A line in the triangle's plane misses.
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
    bool inside = (min(e0, min(e1, e2)) >= real(0) || max(e0, max(e1, e2)) <= real(0)) && determinant != real(0);
    real inverse = determinant != real(0) ? real(1) / determinant : real(0);
    TriangleHit hit;
    hit.hit = false;
    hit.t = tMax;
    hit.b1 = e1 * inverse;  // also where a kernel that asks again for a hit rounds it to just outside
    hit.b2 = e2 * inverse;
    if (inside) {  // few are, which lets a GPU skip the rest
        vec3 depths = vec3(a.z, b.z, c.z) * shear.scale.z;
        real nearest = min(depths.x, min(depths.y, depths.z));
        real farthest = max(depths.x, max(depths.y, depths.z));
        PlaneHit plane = intersectPlane(shear.direction, v0 - origin, v1 - v0, v2 - v0);
        // Seen edge-on, all that is certain is that a hit lies between the nearest and the farthest vertex.
        bool ahead = plane.steep ? plane.ahead : nearest > errorGamma(4) * farthest;
        // The mean of the vertices' depths never leaves their range, so it agrees with the boxes around the triangle; right before the origin
        // its rounding can cost the sign, which the plane knows.
        real mean = clamp(dot(vec3(e0, e1, e2), depths) * inverse, nearest, farthest);
        hit.t = mean > real(0) || !plane.steep ? mean : plane.t;
        hit.hit = ahead && hit.t > real(0) && hit.t < tMax;
    }
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
