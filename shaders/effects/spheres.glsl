// Effect `spheres`: analytic spheres among the primitives. Identity: every primitive is a triangle.

struct PrimitiveHit {
    bool hit;
    float t;
};

#ifdef EFFECT_SPHERES

bool isSphere(vec4 row0) { return (floatBitsToUint(row0.w) & MINIRT_PRIMITIVE_SPHERE) != 0u; }

PrimitiveHit intersectPrimitive(uint slot, vec3 origin, vec3 direction, Shear shear, float tMax) {
    vec4 row0 = primitiveRow(slot, 0u);
    vec4 row1 = primitiveRow(slot, 1u);
    vec4 row2 = primitiveRow(slot, 2u);
    TriangleHit triangle = intersectTriangle(origin, shear, row0.xyz, row1.xyz, row2.xyz, tMax);
    if (triangle.hit && !isSphere(row0) && passesAlpha(row0, row2, vec2(triangle.b1, triangle.b2), origin, direction)) triangle.hit = false;
    SphereHit sphere = intersectSphere(origin, direction, row0.xyz, row1.x, tMax);
    return isSphere(row0) ? PrimitiveHit(sphere.hit, float(sphere.t)) : PrimitiveHit(triangle.hit, float(triangle.t));
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

PrimitiveHit intersectPrimitive(uint slot, vec3 origin, vec3 direction, Shear shear, float tMax) {
    vec4 row0 = primitiveRow(slot, 0u);
    vec4 row2 = primitiveRow(slot, 2u);
    TriangleHit triangle = intersectTriangle(origin, shear, row0.xyz, primitiveRow(slot, 1u).xyz, row2.xyz, tMax);
    if (triangle.hit && passesAlpha(row0, row2, vec2(triangle.b1, triangle.b2), origin, direction)) triangle.hit = false;
    return PrimitiveHit(triangle.hit, float(triangle.t));
}

void refineSphere(vec4 row0, vec4 row1, vec3 origin, vec3 direction, float t, inout SurfacePoint point) {}

#endif
