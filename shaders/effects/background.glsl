// Radiance of rays that leave the scene. Effect `background_image`: a panorama; identity: a constant.

#ifdef EFFECT_BACKGROUND_IMAGE

vec3 backgroundRadiance(vec3 direction) {
    if (scene.counts.y == MINIRT_NONE) return scene.background.rgb;  // in a kernel with all effects
    return scene.background.rgb * sampleImage(scene.counts.y, equirectUv(direction, scene.background.w));
}

#else

vec3 backgroundRadiance(vec3 direction) { return scene.background.rgb; }

#endif
