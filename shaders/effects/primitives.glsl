// Effects `triangles`, `spheres`: what a scene is made of. Identity of each: no primitive is one.

struct PrimitiveHit {
    bool hit;
    float t;
};

#ifdef EFFECT_TRIANGLES

TriangleHit meetTriangle(vec3 origin, Shear shear, vec4 row0, vec4 row1, vec4 row2, float tMax) {
    return intersectTriangle(origin, shear, row0.xyz, row1.xyz, row2.xyz, tMax);
}

SurfacePoint pointOfTriangle(TriangleHit hit, vec4 row0, vec4 row1, vec4 row2) { return trianglePoint(hit, row0.xyz, row1.xyz, row2.xyz); }

#else

TriangleHit meetTriangle(vec3 origin, Shear shear, vec4 row0, vec4 row1, vec4 row2, float tMax) { return TriangleHit(false, real(0), real(0), real(0)); }

SurfacePoint pointOfTriangle(TriangleHit hit, vec4 row0, vec4 row1, vec4 row2) { return SurfacePoint(vec3(0.0), vec3(0.0), vec3(0.0)); }

#endif

#ifdef EFFECT_SPHERES

bool isSphere(vec4 row0) {
#ifdef EFFECT_TRIANGLES
    return (floatBitsToUint(row0.w) & MINIRT_PRIMITIVE_SPHERE) != 0u;
#else
    return true;
#endif
}

PrimitiveHit meetSphere(PrimitiveHit triangle, vec4 row0, vec4 row1, vec3 origin, vec3 direction, float tMax) {
    SphereHit sphere = intersectSphere(origin, direction, row0.xyz, row1.x, tMax);
    return isSphere(row0) ? PrimitiveHit(sphere.hit, float(sphere.t)) : triangle;
}

/// Puts the hit's point on the sphere where the primitive is one.
void refineSphere(vec4 row0, vec4 row1, vec3 origin, vec3 direction, float t, inout SurfacePoint point) {
    SurfacePoint onSphere = spherePoint(origin, direction, t, row0.xyz, row1.x);
    bool sphere = isSphere(row0);
    point.p = sphere ? onSphere.p : point.p;
    point.pError = sphere ? onSphere.pError : point.pError;
    point.ng = sphere ? onSphere.ng : point.ng;
}

#else

bool isSphere(vec4 row0) { return false; }
PrimitiveHit meetSphere(PrimitiveHit triangle, vec4 row0, vec4 row1, vec3 origin, vec3 direction, float tMax) { return triangle; }
void refineSphere(vec4 row0, vec4 row1, vec3 origin, vec3 direction, float t, inout SurfacePoint point) {}

#endif

PrimitiveHit intersectPrimitive(uint slot, vec3 origin, vec3 direction, Shear shear, float tMax) {
    vec4 row0 = primitiveRow(slot, 0u);
    vec4 row1 = primitiveRow(slot, 1u);
    vec4 row2 = primitiveRow(slot, 2u);
    TriangleHit triangle = meetTriangle(origin, shear, row0, row1, row2, tMax);
    if (triangle.hit && !isSphere(row0) && passesAlpha(row0, row2, vec2(triangle.b1, triangle.b2), origin, direction)) triangle.hit = false;
    return meetSphere(PrimitiveHit(triangle.hit, float(triangle.t)), row0, row1, origin, direction, tMax);
}
