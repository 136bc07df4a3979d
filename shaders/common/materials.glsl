// The materials of the scene.

layout(std430, binding = MINIRT_BINDING_MATERIALS) readonly buffer MaterialBuffer { minirt_material materials[]; };
