// What every kernel shares: specialisation, the frame that the host pushes, the film, the counters.

layout(local_size_x_id = MINIRT_SPEC_GROUP_SIZE) in;

// Per device class, set by the host (minirt.h); the defaults only make the module valid.
layout(constant_id = MINIRT_SPEC_STACK_IS_SHARED) const bool STACK_IS_SHARED = false;
layout(constant_id = MINIRT_SPEC_SHARED_STACK_WORDS) const uint SHARED_STACK_WORDS = 1u;
layout(constant_id = MINIRT_SPEC_PRIVATE_STACK_WORDS) const uint PRIVATE_STACK_WORDS = 64u;
layout(constant_id = MINIRT_SPEC_STEP_BUDGET) const uint STEP_BUDGET = 1048576u;
layout(constant_id = MINIRT_SPEC_INTERLEAVE_GROUPS) const bool INTERLEAVE_GROUPS = false;
layout(constant_id = MINIRT_SPEC_STACK_LEVELS) const uint STACK_LEVELS = 64u;

layout(constant_id = MINIRT_SPEC_FETCH_TEXELS) const bool FETCH_TEXELS = false;

layout(push_constant) uniform FrameBlock { minirt_frame frame; };
layout(std140, binding = MINIRT_BINDING_SCENE) uniform SceneBlock { minirt_scene_rows scene; };
layout(std430, binding = MINIRT_BINDING_FILM) buffer FilmBuffer { vec4 film[]; };           // sum of radiance, number of samples
layout(std430, binding = MINIRT_BINDING_RAY_COUNTS) buffer CountBuffer { uvec2 rayCounts[]; };  // shadow, secondary; a pixel
layout(std430, binding = MINIRT_BINDING_COUNTERS) buffer CounterBuffer { minirt_counters counters; };

/// An invocation's pixel, and its place among the pixels of the dispatch.
struct PixelTask {
    bool valid;  // false outside of the region
    uvec2 pixel;
    uint filmIndex;
    uint slot;
};

/// The pixel of a slot. A block of 8 x 8 pixels lies together, in Morton order: neighbours in a subgroup see the same part of the scene.
PixelTask taskOf(uint slot) {
    uint block = frame.blocks.x + slot / gl_WorkGroupSize.x;
    uint lane = slot % gl_WorkGroupSize.x;
    uvec2 inBlock = uvec2(everySecondBit(lane), everySecondBit(lane >> 1));
    PixelTask task;
    task.pixel = frame.region.xy + uvec2(block % frame.blocks.y, block / frame.blocks.y) * 8u + inBlock;
    task.valid = task.pixel.x < frame.region.z && task.pixel.y < frame.region.w;
    task.filmIndex = task.pixel.y * frame.size.x + task.pixel.x;
    task.slot = slot;
    return task;
}

/// Of the invocation's group. Some devices give each core one half of the grid: let both halves be alike.
uint groupNumber(uint mostInChunk) {
    return INTERLEAVE_GROUPS ? interleaved(gl_WorkGroupID.x, gl_NumWorkGroups.x, mostInChunk) : gl_WorkGroupID.x;
}

/// That of an invocation: a group is a block.
PixelTask pixelTask() { return taskOf(groupNumber(1u) * gl_WorkGroupSize.x + gl_LocalInvocationIndex); }

vec3 cameraDirection(uvec2 pixel, uint sampleIndex) {
    vec2 at = (vec2(pixel) + pixelSample(sampleIndex)) / vec2(frame.size.xy) * 2.0 - 1.0;
    return normalize(frame.forward.xyz + at.x * frame.right.xyz - at.y * frame.up.xyz);
}

bool hasNan(vec3 v) { return v.x != v.x || v.y != v.y || v.z != v.z; }

/// Adds to a pixel; `finished` completes its sample. A NaN counts and adds nothing.
void addToFilm(uint index, vec3 radiance, bool finished, uvec2 rays) {
    if (hasNan(radiance)) {
        atomicAdd(counters.nan_pixels, 1u);
        radiance = vec3(0.0);
    }
    film[index] += vec4(radiance, finished ? 1.0 : 0.0);
    rayCounts[index] += rays;
}
