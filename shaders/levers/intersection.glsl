// Lever `intersection`. Default: the watertight test of traverse/triangle.glsl. Else Moeller and Trumbore's (1997), which leaves gaps along edges that
// two triangles share; with the epsilon of miniRTRender it also loses triangles for being small or far, as a determinant has units of area.

#if defined(INTERSECTION_MOLLER_TRUMBORE) || defined(INTERSECTION_MOLLER_TRUMBORE_EPSILON)

#ifdef INTERSECTION_MOLLER_TRUMBORE_EPSILON
const float TRIANGLE_EPSILON = 1e-3;
#else
const float TRIANGLE_EPSILON = 0.0;
#endif

TriangleHit intersectMollerTrumbore(vec3 origin, Shear shear, vec3 v0, vec3 v1, vec3 v2, real tMax) {
    vec3 u = v1 - v0;
    vec3 v = v2 - v0;
    vec3 s = origin - v0;
    vec3 p = cross(shear.direction, v);
    vec3 q = cross(s, u);
    real determinant = dot(u, p);
    real inverse = real(1) / determinant;
    TriangleHit hit;
    hit.b1 = dot(s, p) * inverse;
    hit.b2 = dot(shear.direction, q) * inverse;
    hit.t = dot(v, q) * inverse;
    bool inside = hit.b1 >= real(0) && hit.b2 >= real(0) && hit.b1 + hit.b2 <= real(1);
    hit.hit = inside && abs(determinant) > TRIANGLE_EPSILON && hit.t > TRIANGLE_EPSILON && hit.t < tMax;
    return hit;
}

#define intersectTriangle intersectMollerTrumbore

#endif
