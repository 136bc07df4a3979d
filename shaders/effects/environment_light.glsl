// Effect `environment_light`: directions in which the background shines are picked. Identity: they are found by chance.

#ifdef EFFECT_ENVIRONMENT_LIGHT

const bool BACKGROUND_SHINES = true;

layout(binding = MINIRT_BINDING_ENVIRONMENT) uniform usamplerBuffer cellRows;

/// Density per steradian with which a path picks this direction, of all that it can pick.
float environmentPdf(vec3 direction) {
    uvec2 size = scene.environment.xy;
    if (size.x == 0u) return 0.0;  // in a kernel with all effects
    uvec2 cell = min(uvec2(equirectUv(direction, scene.background.w) * vec2(size)), size - 1u);
    float share = uintBitsToFloat(texelFetch(cellRows, int(cell.y * size.x + cell.x)).w);
    return uintBitsToFloat(scene.environment.z) * share * cellPdf(cell.y, size.x, size.y);
}

/// `bits` pick the cell, `u` the direction in it.
vec3 pickDirection(uvec2 bits, vec2 u) {
    uvec2 size = max(scene.environment.xy, uvec2(1u));
    uint entry = entryOf(bits.x, size.x * size.y);
    uvec4 row = texelFetch(cellRows, int(entry));
    uint cell = bits.y < row.z ? entry : row.y;
    return directionInCell(cell % size.x, cell / size.x, size.x, size.y, scene.background.w, u);
}

#else

const bool BACKGROUND_SHINES = false;

float environmentPdf(vec3 direction) { return 0.0; }
vec3 pickDirection(uvec2 bits, vec2 u) { return vec3(0.0, 1.0, 0.0); }

#endif
