// What happens to a path where its ray ends. The estimator that the megakernel and the wavefront share (Kajiya 1986; next-event estimation and
// multiple importance sampling after Veach 1997).

/// Paths longer than this survive by chance, as likely as they are bright.
const uint SURE_BOUNCES = 3u;

bool hasEnded(Path path) { return path.throughput == vec3(0.0); }

/// The path's ray has come through `medium` over a distance t.
void passMedium(inout Path path, uint medium, float t) {
    path.radiance += path.throughput * inscattered(medium, t);
    path.throughput *= transmittance(medium, t);
}

/// What shines where the path's ray has met a surface.
void gather(inout Path path, Encounter e, uint slot) {
    float density = emitterPdf(slot, path.vertex, e.surface.p, e.ng, path.direction);
    path.radiance += path.throughput * emission(e.material, e.entering, e.surface.uv) * foundWeight(path.pdf, density);
}

/// The path's ray has left the scene.
void leave(inout Path path) {
    passMedium(path, mediumAround(path.volumes), MINIRT_RAY_END);
    path.radiance += path.throughput * backgroundRadiance(path.direction) * foundWeight(path.pdf, environmentPdf(path.direction));
    path.throughput = vec3(0.0);
}

/// All light together that meets a medium which disperses goes on as one of its channels, as likely as the others.
void chooseChannel(inout Path path, inout Encounter e, uvec2 pixel) {
    if (path.channel != 0u || !dividesLight(e.boundary)) return;
    uint k = min(uint(draw(pixel, path.bounces + 1u, PAIR_SURVIVAL).y * float(CHANNELS)), CHANNELS - 1u);
    path.channel = channelAt(k, keyOf(pixel));
    path.throughput *= channelShare(path.channel) * float(CHANNELS);
    e.eta = iorRatio(e.boundary, e.material, e.entering, path.channel);
}

/// What a picked light adds at the surface if nothing is in its way.
vec3 lightAt(Path path, Encounter e, Bsdf bsdf, LightRay light) {
    BsdfValue value = evalBsdf(bsdf, light.wi);
    float cosine = dot(bsdf.basis.n, light.wi);
    bool phongUnderPoint = !light.sized && !isPhysical(e.material) && cosine > 0.0;
    if (phongUnderPoint) {  // as Whitted's tracer shades it
        value.f = e.material.diffuse.rgb * e.surface.diffuseTexture * cosine;
        value.f += highlight(e.material, bsdf.basis.n, light.wi, -path.direction);
    }
    return path.throughput * value.f * light.light * (pickedWeight(light.pdf, light.sized ? value.pdf : 0.0) / light.pdf);
}

/// Where light at rough lobes counts from: on the curved surface that smooth normals describe, but for glass, which has a back.
vec3 roughPoint(Encounter e, Bsdf bsdf) { return bsdf.frosted > 0.0 ? e.surface.p : e.surface.p + e.surface.lift; }

/// Picks a light and starts the shadow ray towards it; the ray is empty where no light adds anything.
Traversal startShadow(inout Path path, Encounter e, Bsdf bsdf, uvec2 pixel) {
    vec3 from = roughPoint(e, bsdf);
    LightRay light = pickLight(from, pixel, path.bounces + 1u);
    path.unshadowed = light.pdf > 0.0 ? lightAt(path, e, bsdf, light) : vec3(0.0);
    if (importance(path.unshadowed) <= 0.0) return noRay();
    bool behind = dot(light.wi, e.ng) < 0.0;
    vec3 origin = behind ? belowSurface(e) : offsetRayOrigin(from, e.surface.pError, e.ng, e.ng);
    const float rounding = 4.0 * MACHINE_EPSILON;
    path.lightDistance = light.distance >= MINIRT_RAY_END ? MINIRT_RAY_END : (light.distance - dot(origin - from, light.wi)) * (1.0 - rounding);
    path.lightSized = light.sized;
    path.shadowVolumes = behind ? e.boundary.transmitted : e.boundary.reflected;
    path.phase = PHASE_SHADOW;
    return beginTraversal(origin, light.wi, path.lightDistance, !SHADOWS_PASS);
}

/// Whether a surface lets light pass straight, so that a path that passes is where a shadow ray would be.
bool passesStraight(Encounter e) { return e.boundary.skipped || (isClear(e.material) && (isThin(e.material) || e.eta == 1.0)); }

/// Chooses where the path goes on from the surface, if it does.
void depart(inout Path path, Encounter e, Bsdf bsdf, uvec2 pixel) {
    uint vertex = path.bounces + 1u;
    Departure next = sampleBsdf(bsdf, draw(pixel, vertex, PAIR_LOBE), draw(pixel, vertex, PAIR_DIRECTION));
    bool straight = next.behind && next.pdf <= 0.0 && passesStraight(e);
    bool goesOn = straight || path.bounces < frame.sampling.z || (path.bounces == frame.sampling.z && next.pdf > 0.0);
    path.throughput *= goesOn ? next.weight : vec3(0.0);
    path.origin = next.behind ? belowSurface(e) : aboveSurface(e);
    if (!next.behind && next.pdf > 0.0) path.origin = offsetRayOrigin(roughPoint(e, bsdf), e.surface.pError, e.ng, e.ng);
    path.direction = next.wi;
    path.volumes = next.behind ? e.boundary.transmitted : e.boundary.reflected;
    if (straight) return;
    path.pdf = next.pdf;
    path.vertex = roughPoint(e, bsdf);
    path.bounces++;
    float survival = path.bounces > SURE_BOUNCES ? min(importance(path.throughput), 1.0) : 1.0;
    bool survives = draw(pixel, vertex, PAIR_SURVIVAL).x < survival;
    path.throughput = survives ? path.throughput / survival : vec3(0.0);
}

/// The path has met a surface. Gives the shadow ray, empty where there is none; the path's own next ray is in `path`.
Traversal visit(inout Path path, Encounter e, uint slot, float t, uvec2 pixel) {
    chooseChannel(path, e, pixel);
    passMedium(path, e.boundary.from, t);
    if (e.boundary.skipped) {  // costs neither depth nor random numbers
        path.origin = belowSurface(e);
        path.volumes = e.boundary.transmitted;
        if (!SHADOWS_PASS) path.pdf = 0.0;  // no shadow ray gets here
        return noRay();
    }
    gather(path, e, slot);
    Bsdf bsdf = bsdfAt(e, path.direction);
    Traversal shadow = noRay();
    if (path.bounces <= frame.sampling.z && isRough(bsdf)) shadow = startShadow(path, e, bsdf, pixel);
    depart(path, e, bsdf, pixel);
    return shadow;
}

/// The shadow ray goes on behind a surface that lets light pass straight. Light with size that refracting glass would bend is left to paths.
Traversal passShadow(inout Path path, Traversal ray, Encounter e) {
    vec3 share = transmittance(e.boundary.from, ray.t);
    if (!e.boundary.skipped) share *= passingShare(e.material, ray.direction, dot(ray.direction, e.n) < 0.0 ? e.n : e.ng, e.eta);
    if (path.lightSized && !passesStraight(e)) share = vec3(0.0);
    path.unshadowed *= share;
    path.shadowVolumes = e.boundary.transmitted;
    vec3 origin = belowSurface(e);
    if (path.lightDistance < MINIRT_RAY_END) path.lightDistance = max(path.lightDistance - dot(origin - ray.origin, ray.direction), 0.0);
    Traversal onwards = beginTraversal(origin, ray.direction, path.lightDistance, false);
    if (importance(path.unshadowed) <= 0.0) onwards.node = NODE_NONE;
    return onwards;
}

/// The shadow ray has reached the light.
void addPicked(inout Path path, Traversal ray) { path.radiance += path.unshadowed * transmittance(mediumAround(path.shadowVolumes), ray.t); }

/// The surface that the ray in flight has met.
Encounter encounterOf(Path path, Traversal ray) {
    VolumeList volumes = path.volumes;
    if (path.phase == PHASE_SHADOW) volumes = path.shadowVolumes;
    Encounter e = encounterAt(ray.origin, ray.direction, ray.slot == MINIRT_NONE ? 0u : ray.slot, ray.t, volumes, path.channel);
    if (ray.slot != MINIRT_NONE && e.boundary.overflow) atomicAdd(counters.volume_overflow, 1u);
    return e;
}

/// The path's own ray, or the one to the camera, has met a surface: gives the ray that follows before the path's next one, empty where there is none.
Traversal meetSurface(inout Path path, Traversal ray, Encounter e, uvec2 pixel) {
    if (!TRACKS_VOLUMES || path.phase != PHASE_CAMERA) return visit(path, e, ray.slot, ray.t, pixel);
    path.volumes = e.boundary.transmitted;
    return passToCamera(ray, path.origin, e);
}

/// The same for rays that have met nothing.
void meetNothing(inout Path path) {
    if (!TRACKS_VOLUMES || path.phase != PHASE_CAMERA) leave(path);
}

/// Whether a shadow ray must look at the surface it has met.
bool looksThrough(Traversal shadow) { return SHADOWS_PASS && shadow.slot != MINIRT_NONE && mayBeClear(shadow.slot); }

/// The path's next ray, or `before` it another one.
Traversal nextRay(inout Path path, Traversal before, inout uvec2 rays) {
    if (!isDone(before)) {
        rays.x += path.phase == PHASE_SHADOW ? 1u : 0u;
        return before;
    }
    rays.y += !hasEnded(path) && path.phase != PHASE_CAMERA ? 1u : 0u;
    path.phase = hasEnded(path) ? PHASE_DONE : PHASE_CLOSEST;
    return beginRay(path);
}

/// What a path adds to its pixel.
vec3 clamped(vec3 radiance) {
    float limit = frame.up.w;
    float brightest = maxComponent(radiance);
    return limit > 0.0 && brightest > limit ? radiance * (limit / brightest) : radiance;
}
