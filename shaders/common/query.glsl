// Rays of the host's and what they hit. Ray i is pixel i of an image 8 pixels wide, so a group takes 64 consecutive rays.
// frame.sampling.y: 1 for any hit.

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

Traversal beginQuery(uint index) {
    QueryRay query = queryRays[index];
    return beginTraversal(query.origin, query.direction, query.tMax, frame.sampling.y != 0u);
}
