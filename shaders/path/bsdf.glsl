// What a surface does to light, as path tracers follow it: a mirror ray, a refracted ray, an opaque lobe and frosted glass, of which a path takes one.

struct Bsdf {
    Basis basis;  // around the shading normal, on the side of the path
    vec3 wo;      // where the path came from, in the basis
    vec3 ng;      // geometric normal on that side
    Scatter smoothly;  // mirror and refracted ray, in the scene
    BaseLobe base;
    float opaque;   // share of the base lobe
    float frosted;  // share of frosted glass
    vec3 tint;      // of light that frosted glass lets through
    float alpha;    // its width of slopes
    float eta;
    vec4 odds;      // of a path to take the mirror ray, the refracted ray, the base, frosted glass
};

/// The shading normal, pulled over where the path sees it from behind.
vec3 facingNormal(vec3 n, vec3 wo) {
    const float least = 1e-3;
    float height = dot(n, wo);
    return height > least ? n : normalize(n + wo * (least - height));
}

bool isPhysical(minirt_material material) { return (material.options.x & MINIRT_MATERIAL_PHYSICAL) != 0u; }

Bsdf bsdfAt(Encounter e, vec3 direction) {
    minirt_material m = e.material;
    bool physical = isPhysical(m);
    vec2 finish = surfaceFinish(m, e.surface.uv);
    vec3 albedo = (physical ? m.base.rgb : m.diffuse.rgb) * e.surface.diffuseTexture;
    Bsdf b;
    b.basis = basisAround(facingNormal(e.n, -direction));
    b.wo = intoBasis(b.basis, -direction);
    b.ng = e.ng;
    b.base = baseLobe(m, albedo, finish);
    b.opaque = physical ? 1.0 - m.finish.y : 1.0;
    b.frosted = frosted(m, finish.x);
    b.tint = albedo;
    b.alpha = ggxAlpha(finish.x);
    b.eta = e.eta;
    if (physical) m.transmit.rgb *= e.surface.diffuseTexture;
    b.smoothly = scatter(m, direction, e.ng, b.basis.n, e.eta);
    if (physical && (m.finish.y <= 0.0 || b.frosted > 0.0)) {  // what scatter() takes for a mirror is in the base; frosted glass has no smooth rays
        b.smoothly.reflectWeight = mirrorOf(b.base, finish.x, b.wo.z);
        b.smoothly.refractWeight = vec3(0.0);
        b.opaque = maxComponent(b.smoothly.reflectWeight) > 0.0 ? 0.0 : b.opaque;
    }
    b.odds = vec4(importance(b.smoothly.reflectWeight), importance(b.smoothly.refractWeight), b.opaque * baseImportance(b.base), b.frosted);
    float sum = b.odds.x + b.odds.y + b.odds.z + b.odds.w;
    b.odds = sum > 0.0 ? b.odds / sum : vec4(0.0);
    return b;
}

/// Whether light from other directions than two can arrive.
bool isRough(Bsdf b) { return b.odds.z + b.odds.w > 0.0; }

/// f |cos| of rough lobes towards `wi`, and the density with which sampleBsdf draws it.
struct BsdfValue {
    vec3 f;
    float pdf;
};

BsdfValue evalBsdf(Bsdf b, vec3 wi) {
    vec3 local = intoBasis(b.basis, wi);
    bool sameSide = (local.z > 0.0) == (dot(wi, b.ng) > 0.0);  // light does not leak through where normals disagree
    if (!sameSide || local.z == 0.0) return BsdfValue(vec3(0.0), 0.0);
    vec3 f = b.opaque * evalBase(b.base, b.wo, local);
    float pdf = b.odds.z * pdfBase(b.base, b.wo, local);
    if (b.frosted > 0.0) {
        f += b.frosted * evalFrosted(b.tint, b.alpha, b.eta, b.wo, local);
        pdf += b.odds.w * pdfFrosted(b.alpha, b.eta, b.wo, local);
    }
    return BsdfValue(f, pdf);
}

/// Where a path goes on.
struct Departure {
    vec3 wi;
    vec3 weight;  // f |cos| / density, 0: nowhere
    float pdf;    // 0: the direction was the only one
    bool behind;  // through the surface
};

Departure smoothDeparture(vec3 wi, vec3 weight, float odds, bool behind) { return Departure(wi, weight / max(odds, 1e-30), 0.0, behind); }

/// `choice`: which lobe and which part of it, in [0,1)^2; `u`: where in it.
Departure sampleBsdf(Bsdf b, vec2 choice, vec2 u) {
    if (choice.x < b.odds.x) return smoothDeparture(b.smoothly.reflected, b.smoothly.reflectWeight, b.odds.x, false);
    if (choice.x < b.odds.x + b.odds.y) return smoothDeparture(b.smoothly.refracted, b.smoothly.refractWeight, b.odds.y, true);
    bool isBase = choice.x < b.odds.x + b.odds.y + b.odds.z || b.odds.w <= 0.0;
    vec3 local = isBase ? sampleBase(b.base, b.wo, u, choice.y) : vec3(0.0, 0.0, 1.0);
    if (!isBase) {
        BsdfSample through = sampleFrosted(b.alpha, b.eta, b.wo, u, choice.y);
        vec3 tint = through.wi.z < 0.0 ? b.tint : vec3(1.0);
        if (through.pdf <= 0.0)  // nothing bends the light, or it ends
            return smoothDeparture(fromBasis(b.basis, through.wi), b.frosted * tint * through.weight, b.odds.w, through.wi.z < 0.0);
        local = through.wi;
    }
    vec3 wi = fromBasis(b.basis, local);
    BsdfValue value = evalBsdf(b, wi);
    return Departure(wi, value.pdf > 0.0 ? value.f / value.pdf : vec3(0.0), value.pdf, local.z < 0.0);
}
