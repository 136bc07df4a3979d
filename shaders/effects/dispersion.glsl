// Effects `dispersion`, `spectral`, and the index of refraction for `nesting`. Identities: one index for all light; three channels rather than
// wavelengths; the material's own index.
//
// A segment's channel: 0 is all light together. Light is divided where it first meets a medium that disperses; its parts keep their channel.

#ifdef EFFECT_DISPERSION

/// All indices of a medium that does not disperse are the same number.
bool disperses(vec4 ior) { return ior.r != ior.b; }

/// Whether the parts of all light go different ways there.
bool dividesLight(Boundary boundary) {
    vec4 from = mediumRow(boundary.from, 1);
    vec4 to = mediumRow(boundary.to, 1);
    return boundary.isVolume && !boundary.skipped && (disperses(from) || disperses(to)) && any(notEqual(from, to));
}

uint packDepth(uint depth, uint channel) { return depth | channel << 16; }
uint depthIn(uint word) { return word & 0xffffu; }
uint channelIn(uint word) { return word >> 16; }

#ifdef EFFECT_SPECTRAL

layout(binding = MINIRT_BINDING_SPECTRUM) uniform usamplerBuffer spectrumRows;

// Channels are entries of the table, plus one.
const uint CHANNELS = 4u;

vec4 spectrumRow(uint channel) { return uintBitsToFloat(texelFetch(spectrumRows, int(channel) - 1)); }

uint channelAt(uint k, uvec2 pixel) { return 1u + wavelengthEntry(pixel, frame.sampling.x, k, MINIRT_SPECTRUM_BITS); }

vec3 channelShare(uint channel) { return spectrumRow(channel).rgb / float(CHANNELS); }

float mediumIndex(uint medium, uint channel) {
    vec4 end = mediumRow(medium, 3);
    float one = indexOnCurve(mediumRow(medium, 2), end.x, end.y, spectrumRow(max(channel, 1u)).w);
    return channel == 0u ? mediumRow(medium, 1).w : one;
}

/// What ends a ray: colours of single wavelengths have negative parts, and four rays make up one.
float importance(vec3 throughput) { return float(CHANNELS) * maxComponent(abs(throughput)); }

#else

const uint CHANNELS = 3u;

uint channelAt(uint k, uvec2 pixel) { return 1u + k; }

vec3 channelShare(uint channel) { return vec3(equal(uvec3(channel), uvec3(1u, 2u, 3u))); }

float mediumIndex(uint medium, uint channel) {
    vec4 ior = mediumRow(medium, 1);
    return channel == 1u ? ior.r : channel == 2u ? ior.g : channel == 3u ? ior.b : ior.w;
}

float importance(vec3 throughput) { return maxComponent(throughput); }

#endif

#else

const uint CHANNELS = 1u;

bool dividesLight(Boundary boundary) { return false; }
uint packDepth(uint depth, uint channel) { return depth; }
uint depthIn(uint word) { return word; }
uint channelIn(uint word) { return 0u; }
uint channelAt(uint k, uvec2 pixel) { return 0u; }
vec3 channelShare(uint channel) { return vec3(1.0); }
float importance(vec3 throughput) { return maxComponent(throughput); }

#ifdef EFFECT_NESTING
float mediumIndex(uint medium, uint channel) { return mediumRow(medium, 1).w; }
#endif

#endif

/// Index of refraction behind the surface over the one in front.
#if defined(EFFECT_NESTING) || defined(EFFECT_DISPERSION)

float iorRatio(Boundary boundary, minirt_material material, bool entering, uint channel) {
    float from = mediumIndex(boundary.from, channel);
    return (boundary.isVolume ? mediumIndex(boundary.to, channel) : material.specular.w) / from;
}

#else

float iorRatio(Boundary boundary, minirt_material material, bool entering, uint channel) {
    // What is opaque mirrors alike from both sides.
    return entering || !boundary.isVolume ? material.specular.w : 1.0 / material.specular.w;
}

#endif
