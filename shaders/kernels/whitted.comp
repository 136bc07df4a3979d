// Whitted's ray tracer (CACM 1980): a tree of mirror and refracted rays below each camera ray, hard shadows at every hit.
// Depth first: one ray is in flight, the other branch waits on the pixel's list. Each pass of the loop traces one ray, so there
// is one trace site. A pixel that spends its budget of steps saves where it is and goes on in the next dispatch.

/// A ray of the tree.
struct Segment {
    vec3 origin;
    vec3 direction;
    vec3 throughput;
    uint depth;
};

// What the ray in flight is for.
#define PHASE_DONE 0u
#define PHASE_CLOSEST 1u
#define PHASE_SHADOW 2u

/// A pixel's progress through its tree. Its waiting segments are in the state buffer.
struct TreeWalk {
    uint phase;
    uint waiting;  // segments on the list
    Segment segment;
    uint hitSlot;  // where the segment ended
    float hitT;
    uint light;     // the next light to look at
    vec3 unshadowed;  // what the shadow ray's light adds unless it is blocked
    vec3 radiance;    // gathered so far; summed in one order wherever the work was cut, so that a picture does not depend on it
};

uint waitingWord(uint index) { return MINIRT_WALK_WORDS + MINIRT_TRAVERSAL_WORDS + STACK_LEVELS + index * MINIRT_SEGMENT_WORDS; }

void putSegment(uint slot, inout uint word, Segment segment) {
    putVec3(slot, word, segment.origin);
    putVec3(slot, word, segment.direction);
    putVec3(slot, word, segment.throughput);
    putWord(slot, word, segment.depth);
}

Segment takeSegment(uint slot, inout uint word) {
    Segment segment;
    segment.origin = takeVec3(slot, word);
    segment.direction = takeVec3(slot, word);
    segment.throughput = takeVec3(slot, word);
    segment.depth = takeWord(slot, word);
    return segment;
}

void saveWalk(uint slot, TreeWalk walk, Traversal ray) {
    uint word = 0u;
    putWord(slot, word, walk.phase);
    if (walk.phase == PHASE_DONE) return;
    putWord(slot, word, walk.waiting);
    putSegment(slot, word, walk.segment);
    putWord(slot, word, walk.hitSlot);
    putFloat(slot, word, walk.hitT);
    putWord(slot, word, walk.light);
    putVec3(slot, word, walk.unshadowed);
    putVec3(slot, word, walk.radiance);
    putTraversal(slot, word, ray);
}

void loadWalk(uint slot, inout TreeWalk walk, inout Traversal ray) {
    uint word = 0u;
    walk.phase = takeWord(slot, word);
    if (walk.phase == PHASE_DONE) return;
    walk.waiting = takeWord(slot, word);
    walk.segment = takeSegment(slot, word);
    walk.hitSlot = takeWord(slot, word);
    walk.hitT = takeFloat(slot, word);
    walk.light = takeWord(slot, word);
    walk.unshadowed = takeVec3(slot, word);
    walk.radiance = takeVec3(slot, word);
    ray = takeTraversal(slot, word, walk.phase == PHASE_SHADOW);
}

Traversal traceSegment(inout TreeWalk walk, Segment segment) {
    walk.phase = PHASE_CLOSEST;
    walk.segment = segment;
    return beginTraversal(segment.origin, segment.direction, MINIRT_RAY_END, false);
}

/// Light that adds less than this share of itself is not worth a shadow ray: a unit in the last place of what other lights add.
const float NEGLIGIBLE_SHARE = 5.9604644775390625e-8;

/// Looks for the next light that adds something at the surface, and starts the shadow ray towards it. Without one, or when the budget
/// of steps ends the search, the ray is empty.
Traversal traceShadow(inout TreeWalk walk, inout uint steps, Surface surface, minirt_material material, vec3 ng, vec3 n) {
    Traversal ray = beginTraversal(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, true);
    ray.node = NODE_NONE;
    walk.phase = PHASE_SHADOW;
    walk.unshadowed = vec3(0.0);
    while (walk.light < lightCount() && ray.node == NODE_NONE && steps < STEP_BUDGET) {
        steps++;
        LightSample light = sampleLight(walk.light++, surface.p);
        float cosine = dot(n, light.toLight);
        vec3 share = material.diffuse.rgb * surface.diffuseTexture * max(cosine, 0.0);
        share += cosine > 0.0 ? highlight(material, n, light.toLight, -walk.segment.direction) : vec3(0.0);
        if (maxComponent(share) > NEGLIGIBLE_SHARE) {
            walk.unshadowed = walk.segment.throughput * share * light.irradiance;
            ray = beginTraversal(offsetRayOrigin(surface.p + surface.lift, surface.pError, ng, ng), light.toLight, light.distance, true);
        }
    }
    return ray;
}

bool carriesOn(vec3 weight) { return maxComponent(weight) > frame.position.w; }

/// Follows one of the rays that leave the surface, puts the other on the list; with none, takes one from the list.
Traversal nextSegment(uint slot, inout TreeWalk walk, bool hit, Surface surface, minirt_material material, vec3 ng, vec3 n) {
    Traversal ray = beginTraversal(vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, false);
    Segment from = walk.segment;
    Scatter branches = scatter(material, from.direction, ng, dot(from.direction, n) < 0.0 ? n : ng, dot(from.direction, surface.ng) < 0.0);
    vec3 reflectThroughput = from.throughput * branches.reflectWeight;
    vec3 refractThroughput = from.throughput * branches.refractWeight;
    bool deeper = hit && from.depth < frame.sampling.z;
    bool reflects = deeper && carriesOn(reflectThroughput);
    bool refracts = deeper && carriesOn(refractThroughput);
    Segment reflected = Segment(offsetRayOrigin(surface.p, surface.pError, ng, ng), branches.reflected, reflectThroughput, from.depth + 1u);
    Segment refracted = Segment(offsetRayOrigin(surface.p, surface.pError, ng, -ng), branches.refracted, refractThroughput, from.depth + 1u);
    bool room = walk.waiting < frame.size.z;
    if (reflects && refracts && room) {
        uint word = waitingWord(walk.waiting++);
        putSegment(slot, word, reflected);
    }
    if (reflects && refracts && !room) atomicAdd(counters.segment_overflow, 1u);
    if (refracts) return traceSegment(walk, refracted);
    if (reflects) return traceSegment(walk, reflected);
    walk.phase = PHASE_DONE;
    if (walk.waiting > 0u) {
        uint word = waitingWord(--walk.waiting);
        return traceSegment(walk, takeSegment(slot, word));
    }
    return ray;
}

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    TreeWalk walk = TreeWalk(PHASE_DONE, 0u, Segment(vec3(0.0), vec3(0.0), vec3(0.0), 0u), MINIRT_NONE, 0.0, 0u, vec3(0.0), vec3(0.0));
    Traversal ray;
    if (frame.sampling.w != 0u) {
        loadWalk(task.slot, walk, ray);
        if (walk.phase == PHASE_DONE) return;
    } else {
        vec3 direction = cameraDirection(task.pixel, frame.sampling.x);
        ray = traceSegment(walk, Segment(frame.position.xyz, direction, vec3(1.0), 0u));
    }
    uvec2 rays = uvec2(0u);
    uint steps = 0u;
    while (walk.phase != PHASE_DONE) {
        traverse(ray, steps, STEP_BUDGET);
        if (!isDone(ray) || steps >= STEP_BUDGET) break;
        bool arrived = walk.phase == PHASE_CLOSEST;
        if (arrived) {
            walk.hitSlot = ray.slot;
            walk.hitT = ray.t;
            walk.light = 0u;
            if (ray.slot == MINIRT_NONE) walk.radiance += walk.segment.throughput * backgroundRadiance(walk.segment.direction);
        } else if (ray.slot == MINIRT_NONE) {
            walk.radiance += walk.unshadowed;
        }
        bool hit = walk.hitSlot != MINIRT_NONE;
        Surface surface = surfaceAt(walk.segment.origin, walk.segment.direction, hit ? walk.hitSlot : 0u, walk.hitT);
        minirt_material material = fetchMaterial(surface.material);
        float side = dot(walk.segment.direction, surface.ng) < 0.0 ? 1.0 : -1.0;
        vec3 ng = surface.ng * side;
        vec3 n = surface.n * side;
        if (arrived && hit) walk.radiance += walk.segment.throughput * emission(material);
        if (hit && walk.light < lightCount()) {
            ray = traceShadow(walk, steps, surface, material, ng, n);
            rays.x += isDone(ray) ? 0u : 1u;
        }
        bool allLightsSeen = isDone(ray) && walk.light == lightCount();
        if (!hit || allLightsSeen) {
            ray = nextSegment(task.slot, walk, hit, surface, material, ng, n);
            rays.y += walk.phase == PHASE_CLOSEST ? 1u : 0u;
        }
        steps += 2u;  // this pass, and the last one of the search for lights
    }
    bool finished = walk.phase == PHASE_DONE;
    addToFilm(task.filmIndex, finished ? walk.radiance : vec3(0.0), finished, rays);
    saveWalk(task.slot, walk, ray);
    if (!finished) atomicAdd(counters.pending, 1u);
    if (!finished && frame.size.w != 0u) atomicAdd(counters.unfinished, 1u);
}
