// From a hit to the surface there.

struct Surface {
    vec3 p;
    vec3 pError;    // bound of the absolute error of p
    vec3 ng;        // unit geometric normal, outward
    vec3 n;         // unit shading normal, on the side of ng
    vec3 lift;      // shadow rays start at p + lift
    uint material;  // checkers resolved
    vec2 uv;
    vec3 diffuseTexture;
};

/// `origin`, `direction`: the ray that found primitive `slot` at distance `t`. Barycentrics are computed again rather than carried along:
/// the same ray gives the same bits.
Surface surfaceAt(vec3 origin, vec3 direction, uint slot, float t) {
    vec4 row0 = primitiveRow(slot, 0u);
    vec4 row1 = primitiveRow(slot, 1u);
    vec4 row2 = primitiveRow(slot, 2u);
    TriangleHit hit = meetTriangle(origin, shearOf(direction), row0, row1, row2, MINIRT_RAY_END);
    vec2 b = vec2(hit.b1, hit.b2);
    SurfacePoint point = pointOfTriangle(hit, row0, row1, row2);
    refineSphere(row0, row1, origin, direction, t, point);
    Surface surface;
    surface.p = point.p;
    surface.pError = point.pError;
    surface.ng = point.ng;
    uint corners = floatBitsToUint(row2.w);
    surface.n = shadingNormal(corners, row0.xyz, row1.xyz, row2.xyz, b, surface.p, surface.ng, surface.lift);
    surface.material = resolveMaterial(floatBitsToUint(row0.w) & ~MINIRT_PRIMITIVE_SPHERE, surface.p, surface.ng);
    minirt_material material = fetchMaterial(surface.material);
    surface.uv = surfaceUv(corners, b);
    surface.diffuseTexture = diffuseTexture(material.options.y, corners, surface.uv);
    surface.n = mappedNormal(material, corners, surface.uv, row0.xyz, row1.xyz, row2.xyz, surface.n);
    return surface;
}
