// A path on its way, and how it is kept between dispatches.

/// What the ray in flight is for.
#define PHASE_DONE 0u
#define PHASE_CLOSEST 1u  // the path itself
#define PHASE_SHADOW 2u   // to the light that was picked at the last vertex
#define PHASE_CAMERA 3u   // to the camera from outside of all volumes, to find out which volumes that is in

/// `throughput` is that of the ray from `origin`, which follows once a shadow ray is done.
struct Path {
    uint phase;
    uint bounces;
    uint channel;  // of its light; 0: all of it
    vec3 origin;
    vec3 direction;
    vec3 throughput;  // zero: the path has ended
    vec3 radiance;    // gathered so far
    VolumeList volumes;
    float pdf;        // density of `direction` when it was drawn; 0: it was the only one
    vec3 vertex;      // where it was drawn
    vec3 unshadowed;  // what the picked light adds unless something is in its way
    float lightDistance;  // from the shadow ray's origin
    bool lightSized;
    VolumeList shadowVolumes;
};

Path noPath() {
    Path path;
    path.phase = PHASE_DONE;
    path.bounces = 0u;
    path.channel = 0u;
    path.origin = vec3(0.0);
    path.direction = vec3(0.0, 0.0, 1.0);
    path.throughput = vec3(0.0);
    path.radiance = vec3(0.0);
    path.volumes = noVolumes();
    path.pdf = 0.0;
    path.vertex = vec3(0.0);
    path.unshadowed = vec3(0.0);
    path.lightDistance = 0.0;
    path.lightSized = false;
    path.shadowVolumes = noVolumes();
    return path;
}

/// MINIRT_PATH_WORDS(SAVED_VOLUMES) words. The first five, its phase to its radiance, are all that is read of a path that is done.
void putPath(uint slot, inout uint word, Path path) {
    putWord(slot, word, path.phase | (path.lightSized ? 4u : 0u));
    putWord(slot, word, packDepth(path.bounces, path.channel));
    putVec3(slot, word, path.radiance);
    putVec3(slot, word, path.origin);
    putVec3(slot, word, path.direction);
    putVec3(slot, word, path.throughput);
    putFloat(slot, word, path.pdf);
    putVec3(slot, word, path.vertex);
    putVec3(slot, word, path.unshadowed);
    putFloat(slot, word, path.lightDistance);
    putVolumes(slot, word, path.volumes);
    putVolumes(slot, word, path.shadowVolumes);
}

Path takePath(uint slot, inout uint word) {
    Path path;
    uint first = takeWord(slot, word);
    path.phase = first & 3u;
    path.lightSized = (first & 4u) != 0u;
    uint depth = takeWord(slot, word);
    path.bounces = depthIn(depth);
    path.channel = channelIn(depth);
    path.radiance = takeVec3(slot, word);
    path.origin = takeVec3(slot, word);
    path.direction = takeVec3(slot, word);
    path.throughput = takeVec3(slot, word);
    path.pdf = takeFloat(slot, word);
    path.vertex = takeVec3(slot, word);
    path.unshadowed = takeVec3(slot, word);
    path.lightDistance = takeFloat(slot, word);
    path.volumes = takeVolumes(slot, word);
    path.shadowVolumes = takeVolumes(slot, word);
    return path;
}

/// The ray of a path's phase.
Traversal beginRay(Path path) { return beginTraversal(path.origin, path.direction, MINIRT_RAY_END, false); }

/// A path at the camera, and its first ray.
Traversal beginPath(uvec2 pixel, out Path path) {
    path = noPath();
    vec2 at = (vec2(pixel) + filterOffset(draw(pixel, 0u, PAIR_PIXEL), scene.environment.w) + 0.5) / vec2(frame.size.xy) * 2.0 - 1.0;
    CameraRay ray = cameraRay(at, draw(pixel, 0u, PAIR_LENS));
    path.phase = PHASE_CLOSEST;
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.throughput = vec3(1.0);
    if (!TRACKS_VOLUMES || (frame.sampling.y & MINIRT_FRAME_CAMERA_INSIDE) == 0u) return beginRay(path);
    path.phase = PHASE_CAMERA;
    return rayToCamera(path.origin);
}
