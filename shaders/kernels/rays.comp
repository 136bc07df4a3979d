// Rays of the host's against the scene: the renderer's traversal and nothing else, for tests and measurements. Blobs of minirtc do
// not hold it. Ray i is pixel i of an image 8 pixels wide, so a group takes 64 consecutive rays. frame.sampling.y: 1 for any hit.

struct QueryRay {
    vec3 origin;
    float unused;
    vec3 direction;  // of any length but 0; t counts in it
    float tMax;
};

struct QueryHit {
    float t;    // tMax where there is none
    uint slot;  // MINIRT_NONE where there is none
};

layout(std430, binding = MINIRT_BINDING_FILM) readonly buffer RayBuffer { QueryRay queryRays[]; };
layout(std430, binding = MINIRT_BINDING_RAY_COUNTS) writeonly buffer HitBuffer { QueryHit queryHits[]; };

#define QUERY_DONE 0u
#define QUERY_PENDING 1u

void main() {
    PixelTask task = pixelTask();
    if (!task.valid) return;
    bool anyHit = frame.sampling.y != 0u;
    uint word = 0u;
    Traversal ray;
    if (frame.sampling.w != 0u) {
        if (takeWord(task.slot, word) == QUERY_DONE) return;
        ray = takeTraversal(task.slot, word, anyHit);
    } else {
        QueryRay query = queryRays[task.filmIndex];
        ray = beginTraversal(query.origin, query.direction, query.tMax, anyHit);
    }
    uint steps = 0u;
    traverse(ray, steps, STEP_BUDGET);
    word = 0u;
    putWord(task.slot, word, isDone(ray) ? QUERY_DONE : QUERY_PENDING);
    if (isDone(ray)) {
        queryHits[task.filmIndex] = QueryHit(ray.t, ray.slot);
    } else {
        putTraversal(task.slot, word, ray);
        atomicAdd(counters.pending, 1u);
    }
}
