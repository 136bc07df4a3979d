// Effects that read images share the texels: all images of the scene, linear, in one texel buffer.

#if defined(EFFECT_TEXTURES) || defined(EFFECT_BACKGROUND_IMAGE) || defined(EFFECT_ALPHA) || defined(EFFECT_NORMAL_MAPS) || \
    defined(EFFECT_SURFACE_MAPS) || defined(EFFECT_EMISSION_MAPS)

layout(binding = MINIRT_BINDING_IMAGES) uniform usamplerBuffer imageRows;
layout(binding = MINIRT_BINDING_TEXELS) uniform samplerBuffer texels;

/// Bilinear; texel centres at half-integers; v = 0 is the top row. Both axes wrap as the image says.
vec4 sampleRgba(uint index, vec2 uv) {
    int row = int(index) * MINIRT_IMAGE_ROWS;
    minirt_image image = minirt_image(texelFetch(imageRows, row), uintBitsToFloat(texelFetch(imageRows, row + 1)));
    ivec2 size = ivec2(image.extent.xy);
    uint flags = image.extent.w;
    uint u = (flags & MINIRT_IMAGE_CLAMP_U) != 0u ? WRAP_CLAMP : (flags & MINIRT_IMAGE_MIRROR_U) != 0u ? WRAP_MIRROR : WRAP_REPEAT;
    uint v = (flags & MINIRT_IMAGE_REPEAT_V) != 0u ? WRAP_REPEAT : (flags & MINIRT_IMAGE_MIRROR_V) != 0u ? WRAP_MIRROR : WRAP_CLAMP;
    vec2 at = vec2(wrapCoordinate(uv.x, u), wrapCoordinate(uv.y, v)) * vec2(size) - 0.5;
    vec2 corner = floor(at);
    vec2 f = at - corner;
    int x0 = wrapTexel(int(corner.x), size.x, u);
    int x1 = wrapTexel(int(corner.x) + 1, size.x, u);
    int row0 = int(image.extent.z) + wrapTexel(int(corner.y), size.y, v) * size.x;
    int row1 = int(image.extent.z) + wrapTexel(int(corner.y) + 1, size.y, v) * size.x;
    vec4 top = mix(texelFetch(texels, row0 + x0), texelFetch(texels, row0 + x1), f.x);
    vec4 bottom = mix(texelFetch(texels, row1 + x0), texelFetch(texels, row1 + x1), f.x);
    vec4 color = mix(top, bottom, f.y);
    return vec4(color.rgb * image.scale.x, color.a);
}

vec3 sampleImage(uint index, vec2 uv) { return sampleRgba(index, uv).rgb; }

#endif
