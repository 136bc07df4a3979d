// What kernels do differently by the class of the device, which the host knows (minirt.h).

/// A CPU device: its driver masks the lanes of a vector, so that both sides of a branch run, and ends loops that run long. The safe default.
layout(constant_id = MINIRT_SPEC_MASKS_LANES) const bool MASKS_LANES = true;
