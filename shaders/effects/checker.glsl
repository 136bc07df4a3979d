// Effect `checker`: one of two materials by world-space cells. Identity: the material itself.

#ifdef EFFECT_CHECKER

uint resolveMaterial(uint index, vec3 p, vec3 ng) {
    minirt_material material = fetchMaterial(index);
    bool even = inEvenCell(p + material.checker.xyz, ng, material.checker.w);
    bool isChecker = (material.options.x & MINIRT_MATERIAL_CHECKER) != 0u;
    return isChecker ? (even ? material.options.z : material.options.w) : index;
}

#else

uint resolveMaterial(uint index, vec3 p, vec3 ng) { return index; }

#endif
