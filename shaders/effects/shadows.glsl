// Effect `transmissive_shadows`: shadow rays go straight through what transmits and are tinted. Identity: everything casts hard shadows.

#ifdef EFFECT_TRANSMISSIVE_SHADOWS

const bool SHADOWS_PASS = true;

bool isClear(minirt_material material) {
    return (material.options.x & MINIRT_MATERIAL_CLEAR_SHADOWS) != 0u && maxComponent(material.transmit.rgb) > 0.0;
}

/// Whether a shadow ray must look at a surface before it knows: a checker is what it is at the point, and a volume's surface may be hidden.
bool mayBeClear(uint slot) {
    minirt_material material = fetchMaterial(materialOf(slot));
    bool checker = (material.options.x & MINIRT_MATERIAL_CHECKER) != 0u;
    return isClear(material) || checker || (TRACKS_VOLUMES && bodyOf(slot) < scene.counts.z);
}

/// The share of light that goes through one surface along a straight line. Where Fresnel splits, the angle counts on the side of the lower index:
/// a slab then passes what it would with its rays bent, and nothing is black for an angle that no bent ray has.
vec3 passingShare(minirt_material material, vec3 d, vec3 n, float eta) {
    Interface boundary = meetInterface(d, n, max(eta, 1.0 / eta));
    float reflectance = splitsByFresnel(material) ? sheetReflectance(material, fresnelShare(material, boundary)) : 0.0;
    return isClear(material) ? material.transmit.rgb * (1.0 - reflectance) : vec3(0.0);
}

#else

const bool SHADOWS_PASS = false;

bool isClear(minirt_material material) { return false; }
bool mayBeClear(uint slot) { return false; }
vec3 passingShare(minirt_material material, vec3 d, vec3 n, float eta) { return vec3(0.0); }

#endif
