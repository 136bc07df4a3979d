// Included in f32 and in f64 (optics_test.cpp).

/// Where the ray is after `bounces` reflections at the inside of the cube [-1/2,1/2]^3. With `lifted` each ray starts where
/// offsetRayOrigin says, else at the hit itself.
inline vec3 cubePath(vec3 origin, vec3 direction, int bounces, bool lifted) {
    const auto corner = [](int i) { return vec3(i & 1, i >> 1 & 1, i >> 2 & 1) - vec3(0.5); };
    const int faces[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                              {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    int lastWall = -1;
    for (int bounce = 0; bounce < bounces; ++bounce) {
        const Shear shear = shearOf(direction);
        TriangleHit best{false, real(10), real(0), real(0)};
        SurfacePoint point{};
        int wall = -1;
        for (int i = 0; i < 12; ++i) {
            if (i / 2 == lastWall) continue;
            const auto& face = faces[i];
            const vec3 v0 = corner(face[0]);
            const vec3 v1 = corner(face[1]);
            const vec3 v2 = corner(face[2]);
            const TriangleHit hit = intersectTriangle(origin, shear, v0, v1, v2, best.t);
            if (!hit.hit) continue;
            best = hit;
            wall = i / 2;
            point = trianglePoint(hit, v0, v1, v2);
        }
        if (!best.hit) return vec3(real(1e9));  // it escaped
        const vec3 inward = dot(direction, point.ng) < real(0) ? point.ng : -point.ng;
        direction = meetInterface(direction, inward, real(1) / real(1.5)).reflected;
        origin = lifted ? offsetRayOrigin(point.p, point.pError, inward, direction) : point.p;
        lastWall = wall;
    }
    return origin;
}
