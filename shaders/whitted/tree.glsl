// What happens where a ray of the tree ends. A kernel before it says where segments wait: `bool hold(uint slot, inout TreeWalk walk, Segment segment)`, of the
// pixel `slot`.

/// A segment waits for its turn, or is lost and counted where there is no room.
void holdOrCount(uint slot, inout TreeWalk walk, Segment segment) {
    if (!hold(slot, walk, segment)) atomicAdd(counters.segment_overflow, 1u);
}

/// All light together that meets a medium which disperses goes on as one of its channels. The others wait, to come here by themselves.
void divideLight(uint slot, uvec2 pixel, inout TreeWalk walk, inout Encounter e) {
    if (walk.segment.channel != 0u || !dividesLight(e.boundary)) return;
    Segment whole = walk.segment;
    UNROLL for (int k = int(CHANNELS) - 1; k >= 0; k--) {
        walk.segment.channel = channelAt(uint(k), pixel);
        walk.segment.throughput = whole.throughput * channelShare(walk.segment.channel);
        if (k > 0) holdOrCount(slot, walk, walk.segment);
    }
    e.eta = iorRatio(e.boundary, e.material, e.entering, walk.segment.channel);
}

/// The shadow ray goes on behind a surface that is clear or hidden, tinted; it ends there when too little of its light is left.
Traversal passShadow(inout TreeWalk walk, Traversal ray, Encounter e) {
    vec3 share = transmittance(e.boundary.from, ray.t);
    if (!e.boundary.skipped) share *= passingShare(e.material, ray.direction, dot(ray.direction, e.n) < 0.0 ? e.n : e.ng, e.eta);
    walk.unshadowed *= share;
    walk.shadowVolumes = e.boundary.transmitted;
    LightSample light = sampleLight(walk.light - 1u, e.surface.p);
    Traversal onwards = beginTraversal(belowSurface(e), ray.direction, light.distance, false);
    if (importance(walk.unshadowed) <= 0.0) onwards.node = NODE_NONE;
    return onwards;
}

/// The rays that leave a surface.
struct Branches {
    bool reflects, refracts;
    Segment reflected, refracted;
};

Branches branchesAt(TreeWalk walk, bool hit, Encounter e) {
    Segment from = walk.segment;
    Scatter branches = scatter(e.material, from.direction, e.ng, dot(from.direction, e.n) < 0.0 ? e.n : e.ng, e.eta);
    bool straight = e.boundary.skipped;  // costs no depth
    vec3 reflectThroughput = straight ? vec3(0.0) : from.throughput * branches.reflectWeight;
    vec3 refractThroughput = straight ? from.throughput : from.throughput * branches.refractWeight;
    bool deeper = hit && (straight || from.depth < frame.sampling.z);
    Branches leaving;
    leaving.reflects = deeper && carriesOn(reflectThroughput, walk, MIRROR_RAY);
    leaving.refracts = deeper && carriesOn(refractThroughput, walk, REFRACTED_RAY);
    leaving.reflected = Segment(aboveSurface(e), branches.reflected, reflectThroughput, from.depth + 1u, from.channel, e.boundary.reflected);
    leaving.refracted = Segment(belowSurface(e), straight ? from.direction : branches.refracted, refractThroughput,
                                straight ? from.depth : from.depth + 1u, from.channel, e.boundary.transmitted);
    return leaving;
}

/// A segment has ended: what its medium takes and adds on the way, then the background or what shines by itself.
void arrive(inout TreeWalk walk, bool hit, Encounter e) {
    uint medium = hit ? e.boundary.from : mediumAround(walk.segment.volumes);
    float distance = hit ? walk.hitT : MINIRT_RAY_END;
    walk.radiance += walk.segment.throughput * inscattered(medium, distance);
    walk.segment.throughput *= transmittance(medium, distance);
    vec3 shine = hit ? (e.boundary.skipped ? vec3(0.0) : emission(e.material, e.entering, e.surface.uv)) : backgroundRadiance(walk.segment.direction);
    walk.radiance += walk.segment.throughput * shine;
    walk.light = e.boundary.skipped ? lightCount() : 0u;
}
