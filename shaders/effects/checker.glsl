// Effect `checker`: one of two materials by world-space cells on the two axes across the geometric normal. Identity: the material itself.

#ifdef EFFECT_CHECKER

uint resolveMaterial(uint index, vec3 p, vec3 ng) {
    minirt_material material = fetchMaterial(index);
    vec3 cell = floor((p + material.checker.xyz) / material.checker.w);
    vec3 a = abs(ng);
    float parity = a.x > a.y && a.x > a.z ? cell.y + cell.z : a.y > a.z ? cell.x + cell.z : cell.x + cell.y;
    bool even = parity - 2.0 * floor(parity * 0.5) == 0.0;
    bool isChecker = (material.options.x & MINIRT_MATERIAL_CHECKER) != 0u;
    return isChecker ? (even ? material.options.z : material.options.w) : index;
}

#else

uint resolveMaterial(uint index, vec3 p, vec3 ng) { return index; }

#endif
