// The materials of the scene. What a kernel reads lies in texel buffers throughout: some drivers fetch those twice as fast as storage buffers.

layout(binding = MINIRT_BINDING_MATERIALS) uniform usamplerBuffer materialRows;

minirt_material fetchMaterial(uint index) {
    int row = int(index) * MINIRT_MATERIAL_ROWS;
    return minirt_material(uintBitsToFloat(texelFetch(materialRows, row)), uintBitsToFloat(texelFetch(materialRows, row + 1)),
                           uintBitsToFloat(texelFetch(materialRows, row + 2)), uintBitsToFloat(texelFetch(materialRows, row + 3)),
                           uintBitsToFloat(texelFetch(materialRows, row + 4)), uintBitsToFloat(texelFetch(materialRows, row + 5)),
                           texelFetch(materialRows, row + 6), uintBitsToFloat(texelFetch(materialRows, row + 7)),
                           uintBitsToFloat(texelFetch(materialRows, row + 8)), texelFetch(materialRows, row + 9));
}
