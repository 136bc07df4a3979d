// Rows of the buffers that traversal reads at every step. The same memory is bound twice: CPU drivers fetch from texel buffers twice as
// fast as from storage buffers, GPUs answer storage loads sooner than texture fetches.

layout(binding = MINIRT_BINDING_NODES) uniform usamplerBuffer nodeTexels;
layout(binding = MINIRT_BINDING_PRIMITIVES) uniform usamplerBuffer primitiveTexels;
layout(std430, binding = MINIRT_BINDING_NODE_STORAGE) readonly buffer NodeStorage { uvec4 nodeStorage[]; };
layout(std430, binding = MINIRT_BINDING_PRIMITIVE_STORAGE) readonly buffer PrimitiveStorage { uvec4 primitiveStorage[]; };

uvec4 nodeRow(uint row) {
    if (FETCH_TEXELS) return texelFetch(nodeTexels, int(row));
    return nodeStorage[row];
}

vec4 primitiveRow(uint slot, uint k) {
    uint row = slot * uint(MINIRT_PRIMITIVE_ROWS) + k;
    if (FETCH_TEXELS) return uintBitsToFloat(texelFetch(primitiveTexels, int(row)));
    return uintBitsToFloat(primitiveStorage[row]);
}
