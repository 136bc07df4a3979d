// Light at rough surfaces: GGX microfacets (Trowbridge and Reitz 1975; Walter et al. 2007) with Smith's shadowing, as a conductor and a
// dielectric coat after glTF's metallic-roughness model and as a rough dielectric. GLSL and C++ (tests/shader_source.hpp).
//
// Directions are of unit length, point away from the surface, and lie in its frame: the shading normal is +z and wo.z > 0; else there is
// no light. `f` is a BSDF of radiance, per steradian, without the cosine; `pdf` is per steradian; `weight` is f |cos(wi)| / pdf.
// `alpha` is the width of the microfacets' slopes, from 1e-6 to 1. Below 1e-3, rounding of float directions makes f and pdf uncertain, by
// 1e-7 / alpha, but both alike: weights stay exact.

/// The width of slopes for a roughness in [0,1] as glTF defines it.
real ggxAlpha(real roughness) { return max(roughness * roughness, real(1e-6)); }

/// Density of microfacet normals, per steradian: the integral of D(h) h.z over the hemisphere is 1. A form without 1 - cos^2.
real ggxDensity(real alpha, vec3 h) {
    real s = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
    return h.z > real(0) ? real(INV_PI) / (alpha * alpha * s * s) : real(0);
}

/// |w.z| (1 + 2 Lambda(w)), with Smith's Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2: finite at grazing angles, where Lambda is not.
real smithStretch(real alpha, vec3 w) { return sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y)); }

/// Share of the microfacets towards w that others do not hide: 1 / (1 + Lambda).
real smithG1(real alpha, vec3 w) {
    real c = abs(w.z);
    return real(2) * c / (c + smithStretch(alpha, w));
}

/// G2 / (4 |wo.z wi.z|) with G2 = 1 / (1 + Lambda(wo) + Lambda(wi)), which knows that heights correlate (Heitz 2014, eq. 99).
real smithVisibility(real alpha, vec3 wo, vec3 wi) {
    real sum = abs(wi.z) * smithStretch(alpha, wo) + abs(wo.z) * smithStretch(alpha, wi);
    return real(0.5) / max(sum, real(1e-30));
}

/// A microfacet normal out of those that wo sees (Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps). 1 - z is
/// kept rather than z, so that nothing cancels near the pole.
vec3 sampleVisibleNormal(real alpha, vec3 wo, vec2 u) {
    vec3 v = normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
    real height = u.y * (real(1) + v.z);
    vec2 p = cosSinTurns(u.x) * sqrt(max(height * (real(2) - height), real(0)));
    return normalize(vec3(alpha * (p.x + v.x), alpha * (p.y + v.y), (real(1) - u.y) * (real(1) + v.z)));
}

/// Density of sampleVisibleNormal: G1(wo) D(h) dot(wo, h) / wo.z.
real visibleNormalPdf(real alpha, vec3 wo, vec3 h) {
    return real(2) * max(dot(wo, h), real(0)) * ggxDensity(alpha, h) / (wo.z + smithStretch(alpha, wo));
}

/// Density of the direction that wo is mirrored to by a visible normal; h is halfway to it.
real mirroredPdf(real alpha, vec3 wo, vec3 h) { return real(0.5) * ggxDensity(alpha, h) / (wo.z + smithStretch(alpha, wo)); }

/// (1 - c)^5: the rise of Schlick's reflectance F0 + (1 - F0) (1 - c)^5 (Schlick 1994) at the cosine c in [0,1].
real schlickRise(real c) {
    real m = max(real(1) - c, real(0));
    return m * m * m * m * m;
}

// What one reflection loses. Light that the rules above call hidden meets further microfacets; without it rough metals are too dark by up to
// 69 % along a direction. The four functions are rational fits from one side (linear programmes) to the integrals for alpha from 1e-6 to 1. Losses are
// too small, but for 1e-4, and rises too great, but for 7e-5; the means are those of the fits, the first too great and the second too small. So
// no surface returns more than 1 + 7e-5 of the light, and white ones at least 0.9954 of it along any direction: of a white furnace, 0.001 is
// lost by metals and 0.0003 by coated bodies in the mean over roughness and the hemisphere.
// Coefficients by alpha alone come first: a compiler shares them between two directions.

/// Least loss that the fit gives: a mean loss that is not 0 keeps what comes back of losses finite in float, for smooth surfaces too.
const real LEAST_LOSS = real(4e-5);

/// 1 minus the directional albedo of a perfectly reflecting GGX surface: the share lost of light that leaves along cos = `mu`.
/// At most 0.0040 less than that, 0.0008 in the mean over roughness and the hemisphere.
real ggxLoss(real alpha, real mu) {
    vec4 powers = vec4(real(1), alpha, alpha * alpha, alpha * alpha * alpha);
    vec3 lower = vec3(powers.x, powers.y, powers.z);
    real a0 = dot(powers, vec4(0.0583568, -0.00474401, 4.18633, -2.79417));
    real a1 = dot(powers, vec4(2.5844, 0.410043, 6.5523, -3.39532));
    real a2 = dot(powers, vec4(-4.75698, -2.82362, -33.8944, 34.067));
    real a3 = dot(powers, vec4(2.11422, 2.72628, 35.1395, -41.9108));
    real b0 = dot(lower, vec3(1, -0.77404, 0.0740398));
    real b1 = dot(lower, vec3(4.09556, 4.57973, -3.79932));
    real b2 = dot(lower, vec3(-12.3793, -15.5028, 19.2712));
    real b3 = dot(lower, vec3(8.56634, 15.0364, -21.2788));
    real scale = real(1) / (mu + alpha);
    real s = mu * scale;
    real a = ((a3 * s + a2) * s + a1) * s + a0;
    real b = ((b3 * s + b2) * s + b1) * s + b0;
    return LEAST_LOSS + s * (alpha * scale) * max(a, real(0)) / b;
}

/// Mean of ggxLoss over the hemisphere under the cosine.
/// At most greater by what takes 0.0007 of the light along a direction.
real ggxMeanLoss(real alpha) {
    real r = sqrt(alpha);
    real a = real(10.9477) + r * (real(102.119) + r * (real(-132.142) + r * real(43.3413)));
    real b = real(1) + r * (real(29.4771) + r * real(10.6552));
    return LEAST_LOSS + alpha * alpha * a / b;
}

/// Directional albedo of the rise of Schlick's reflectance: that of F0 = 0.
/// At most 0.0044 more than that, 0.0003 in the mean.
real ggxRise(real alpha, real mu) {
    real r = sqrt(alpha);
    vec4 powers = vec4(real(1), r, r * r, r * r * r);
    real a0 = dot(powers, vec4(0.00797414, 6.58839, -1.88836, 1.30838));
    real a1 = dot(powers, vec4(0.200392, -10.5502, 5.7301, -11.1551));
    real a2 = dot(powers, vec4(-0.478094, 2.59585, -7.60875, 5.62964));
    real a3 = dot(powers, vec4(0.267067, 1.47222, 2.826, 2.26199));
    real b0 = dot(powers, vec4(1, 9.26884, -5.31945, 8.46331));
    real b1 = dot(powers, vec4(-0.326504, -11.7342, 9.80828, -14.8825));
    real s = mu / (mu + alpha);
    real c = mu + r * (((a3 * s + a2) * s + a1) * s + a0) / (b1 * s + b0);
    return (real(1) - ggxLoss(alpha, mu)) * schlickRise(clamp(c, real(0), real(0.86)));
}

/// Mean of ggxRise over the hemisphere under the cosine.
/// At most 0.0001 less than that.
real ggxMeanRise(real alpha) {
    real a = real(0.0476273) + alpha * (real(0.467924) + alpha * (real(-0.566332) + alpha * real(0.25109)));
    return a / (real(1) + alpha * (real(10.1827) + alpha * real(56.4132)));
}

/// What of the lost light comes back after more than one reflection, for Schlick's reflectance: a geometric series with the mean
/// reflectance (1 + 20 F0) / 21 (Kulla and Conty 2017; with the square, as one more reflection than losses; Turquin 2019).
real multipleReflectance(real meanLoss, real f0) {
    real mean = (real(1) + real(20) * f0) / real(21);
    return mean * mean * (real(1) - meanLoss) / (real(1) - mean * meanLoss);
}

/// A surface of glTF 2.0's metallic-roughness model.
struct MetallicRoughness {
    vec3 baseColor;     // [0,1], linear
    real metallic;      // [0,1]
    real alpha;         // ggxAlpha(roughness)
    real dielectricF0;  // reflectance of the coat along its normal: 0.04 for an index of 1.5
};

/// Reflectance along the normal.
vec3 metallicRoughnessF0(MetallicRoughness m) { return vec3(m.dielectricF0) * (real(1) - m.metallic) + m.baseColor * m.metallic; }

/// The same for light that is reflected more than once, as the share of what is lost.
vec3 multipleReflectances(real meanLoss, vec3 f0) {
    return vec3(multipleReflectance(meanLoss, f0.x), multipleReflectance(meanLoss, f0.y), multipleReflectance(meanLoss, f0.z));
}

/// Share of light that a coat of reflectance f0 keeps from what lies under it, from loss and rise along one direction or their means.
real coatAlbedo(real f0, real loss, real rise, real meanLoss) {
    real single = f0 * (real(1) - loss - rise) + rise;
    return min(single + multipleReflectance(meanLoss, f0) * loss, real(1));
}

/// The BSDF: GGX with Schlick's reflectance, what it loses to further reflections (Kulla and Conty 2017), and a Lambertian base under the coat.
/// glTF's own mixture weighs the base by 1 - F at the half vector, which returns up to twice the light at grazing angles. Here the base gets
/// what the coat lets pass on the way in and out (Kelemen and Szirmay-Kalos 2001): reciprocal, and a white surface stays white.
vec3 evalMetallicRoughness(MetallicRoughness m, vec3 wo, vec3 wi) {
    if (wo.z <= real(0) || wi.z <= real(0)) return vec3(0);
    vec3 h = normalize(wo + wi);
    vec3 f0 = metallicRoughnessF0(m);
    vec3 fresnel = f0 + (vec3(1) - f0) * schlickRise(dot(wo, h));
    vec3 single = fresnel * (ggxDensity(m.alpha, h) * smithVisibility(m.alpha, wo, wi));
    real lossO = ggxLoss(m.alpha, wo.z);
    real lossI = ggxLoss(m.alpha, wi.z);
    real meanLoss = ggxMeanLoss(m.alpha);
    vec3 multiple = multipleReflectances(meanLoss, f0) * (lossO * lossI * real(INV_PI) / meanLoss);
    real passO = real(1) - coatAlbedo(m.dielectricF0, lossO, ggxRise(m.alpha, wo.z), meanLoss);
    real passI = real(1) - coatAlbedo(m.dielectricF0, lossI, ggxRise(m.alpha, wi.z), meanLoss);
    real meanPass = real(1) - coatAlbedo(m.dielectricF0, meanLoss, ggxMeanRise(m.alpha), meanLoss);
    real base = (real(1) - m.metallic) * passO * passI * real(INV_PI) / max(meanPass, real(1e-6));
    return single + multiple + m.baseColor * base;
}

/// Probability with which sampleMetallicRoughness draws a mirrored visible normal rather than a cosine: its share of the albedo along wo.
real mirroredShare(MetallicRoughness m, vec3 wo) {
    vec3 f0 = metallicRoughnessF0(m);
    real loss = ggxLoss(m.alpha, wo.z);
    real rise = ggxRise(m.alpha, wo.z);
    real meanLoss = ggxMeanLoss(m.alpha);
    real pass = real(1) - coatAlbedo(m.dielectricF0, loss, rise, meanLoss);
    vec3 single = f0 * (real(1) - loss - rise) + vec3(rise);
    vec3 rest = multipleReflectances(meanLoss, f0) * loss + m.baseColor * ((real(1) - m.metallic) * pass);
    real mirrored = dot(single, vec3(1));
    real all = mirrored + dot(rest, vec3(1));
    return all > real(0) ? mirrored / all : real(1);
}

/// Density of sampleMetallicRoughness. Its integral falls short of 1 by the samples that end under the surface.
real pdfMetallicRoughness(MetallicRoughness m, vec3 wo, vec3 wi) {
    if (wo.z <= real(0) || wi.z <= real(0)) return real(0);
    real share = mirroredShare(m, wo);
    return share * mirroredPdf(m.alpha, wo, normalize(wo + wi)) + (real(1) - share) * cosineHemispherePdf(wi.z);
}

/// A direction that light may come from. weight 0: there is none, and pdf is 0.
struct BsdfSample {
    vec3 wi;
    vec3 weight;  // f |cos(wi)| / pdf
    real pdf;
};

BsdfSample noSample() {
    BsdfSample none;
    none.wi = vec3(0, 0, 1);
    none.weight = vec3(0);
    none.pdf = real(0);
    return none;
}

/// A direction about as likely as it is bright. `u` and `lobe` in [0,1).
BsdfSample sampleMetallicRoughness(MetallicRoughness m, vec3 wo, vec2 u, real lobe) {
    if (wo.z <= real(0)) return noSample();
    vec3 h = sampleVisibleNormal(m.alpha, wo, u);
    vec3 mirrored = normalize(h * (real(2) * dot(wo, h)) - wo);
    BsdfSample result;
    result.wi = lobe < mirroredShare(m, wo) ? mirrored : cosineHemisphere(u);
    result.pdf = pdfMetallicRoughness(m, wo, result.wi);
    if (result.pdf <= real(0)) return noSample();
    result.weight = evalMetallicRoughness(m, wo, result.wi) * (result.wi.z / result.pdf);
    return result;
}

// The rough dielectric: a body's surface of GGX microfacets that reflect and refract with Fresnel's reflectance (Walter et al. 2007).
// `eta`: index of refraction below over the one above. f is that of radiance, which is denser in the denser medium: transmitted, it has a factor
// 1 / eta^2, so that f(wo, wi) eta^2 is f(wi, wo) seen from below. Light that meets more than one microfacet is lost.

/// An interface closer to nothing than this bends no light: it is passed straight on.
const real LEAST_BEND = real(1e-4);

/// The microfacet normal, to the upper side, that sends wo to wi; zero where none does.
vec3 dielectricNormal(real eta, vec3 wo, vec3 wi) {
    bool mirrored = wi.z > real(0);
    vec3 h = wo + wi * (mirrored ? real(1) : eta);
    real size = length(h);
    if (wo.z <= real(0) || wi.z == real(0) || size == real(0) || abs(eta - real(1)) < LEAST_BEND) return vec3(0);
    h = h * ((h.z < real(0) ? real(-1) : real(1)) / size);
    return dot(wo, h) > real(0) && (mirrored || dot(wi, h) < real(0)) ? h : vec3(0);
}

/// Share of light that the microfacet h reflects.
real microfacetReflectance(real eta, vec3 wo, vec3 h) { return meetInterface(-wo, h, eta).reflectance; }

/// Density of refracted directions over that of their normals, over eta^2: |wi.h| / (wo.h + eta wi.h)^2.
real refractedSpread(real eta, vec3 wo, vec3 wi, vec3 h) {
    real s = dot(wo, h) + eta * dot(wi, h);
    return abs(dot(wi, h)) / (s * s);
}

/// The BSDF: reflection for wi.z > 0, else transmission, with the G2 of reflection for both (as in pbrt-v4). Smith's model has
/// less for transmission, which would only lose more of the light that this BSDF does not follow further.
real evalDielectric(real alpha, real eta, vec3 wo, vec3 wi) {
    vec3 h = dielectricNormal(eta, wo, wi);
    if (h.z <= real(0)) return real(0);
    real reflectance = microfacetReflectance(eta, wo, h);
    real shape = ggxDensity(alpha, h) * smithVisibility(alpha, wo, wi);
    if (wi.z > real(0)) return reflectance * shape;
    return (real(1) - reflectance) * shape * real(4) * dot(wo, h) * refractedSpread(eta, wo, wi, h);
}

/// Density of sampleDielectric. Its integral falls short of 1 by the samples that end on the wrong side.
real pdfDielectric(real alpha, real eta, vec3 wo, vec3 wi) {
    vec3 h = dielectricNormal(eta, wo, wi);
    if (h.z <= real(0)) return real(0);
    real reflectance = microfacetReflectance(eta, wo, h);
    if (wi.z > real(0)) return reflectance * mirroredPdf(alpha, wo, h);
    return (real(1) - reflectance) * visibleNormalPdf(alpha, wo, h) * eta * eta * refractedSpread(eta, wo, wi, h);
}

/// A direction, reflected where `lobe` in [0,1) is less than the reflectance of the microfacet drawn with `u`, else refracted. At most 1 is the
/// weight of a reflected one, and 1 / eta^2 of a refracted one. Where eta is within LEAST_BEND of 1, wo goes straight on, with weight 1
/// and pdf 0, as no other technique can draw it.
BsdfSample sampleDielectric(real alpha, real eta, vec3 wo, vec2 u, real lobe) {
    if (wo.z <= real(0)) return noSample();
    BsdfSample result;
    if (abs(eta - real(1)) < LEAST_BEND) {
        result.wi = -wo;
        result.weight = vec3(1);
        result.pdf = real(0);
        return result;
    }
    vec3 h = sampleVisibleNormal(alpha, wo, u);
    Interface boundary = meetInterface(-wo, h, eta);
    bool mirrored = lobe < boundary.reflectance;
    result.wi = mirrored ? boundary.reflected : boundary.refracted;
    if ((mirrored ? result.wi.z : -result.wi.z) <= real(0)) return noSample();
    real bent = visibleNormalPdf(alpha, wo, h) * eta * eta * refractedSpread(eta, wo, result.wi, h);
    result.pdf = mirrored ? mirroredPdf(alpha, wo, h) * boundary.reflectance : bent * (real(1) - boundary.reflectance);
    if (result.pdf <= real(0)) return noSample();
    real seen = real(2) * smithVisibility(alpha, wo, result.wi) * abs(result.wi.z) * (wo.z + smithStretch(alpha, wo));  // G2 / G1(wo)
    result.weight = vec3(mirrored ? seen : seen / (eta * eta));
    return result;
}
