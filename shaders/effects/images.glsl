// Effects that read images share the texels: all images of the scene, linear, in one texel buffer.

#if defined(EFFECT_TEXTURES) || defined(EFFECT_BACKGROUND_IMAGE) || defined(EFFECT_ALPHA) || defined(EFFECT_SURFACE_MAPS) || \
    defined(EFFECT_NORMAL_MAPS) || defined(EFFECT_EMISSION_MAPS)

layout(binding = MINIRT_BINDING_IMAGES) uniform usamplerBuffer imageRows;
layout(binding = MINIRT_BINDING_TEXELS) uniform samplerBuffer texels;

/// Bilinear; texel centres at half-integers; v = 0 is the top row. `u` wraps, `v` wraps or clamps as the image says.
vec4 sampleTexel(uint index, vec2 uv) {
    int row = int(index) * MINIRT_IMAGE_ROWS;
    minirt_image image = minirt_image(texelFetch(imageRows, row), uintBitsToFloat(texelFetch(imageRows, row + 1)));
    ivec2 size = ivec2(image.extent.xy);
    bool repeats = (image.extent.w & MINIRT_IMAGE_REPEAT_V) != 0u;
    vec2 at = (uv - floor(uv)) * vec2(size);
    if (!repeats) at.y = clamp(uv.y, 0.0, 1.0) * float(size.y);
    at -= 0.5;
    vec2 corner = floor(at);
    vec2 f = at - corner;
    int x0 = wrapTexel(int(corner.x), size.x, true);
    int x1 = wrapTexel(int(corner.x) + 1, size.x, true);
    int row0 = int(image.extent.z) + wrapTexel(int(corner.y), size.y, repeats) * size.x;
    int row1 = int(image.extent.z) + wrapTexel(int(corner.y) + 1, size.y, repeats) * size.x;
    vec4 top = mix(texelFetch(texels, row0 + x0), texelFetch(texels, row0 + x1), f.x);
    vec4 bottom = mix(texelFetch(texels, row1 + x0), texelFetch(texels, row1 + x1), f.x);
    return mix(top, bottom, f.y) * vec4(image.scale.xxx, 1.0);
}

vec3 sampleImage(uint index, vec2 uv) { return sampleTexel(index, uv).rgb; }

#endif
