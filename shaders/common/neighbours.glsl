// The float next to another. GLSL and C++ (tests/shader_source.hpp).

/// The least float above x, for finite x.
float nextUp(float x) {
    uint bits = floatBitsToUint(x);
    return uintBitsToFloat(x == real(0) ? 1u : x > real(0) ? bits + 1u : bits - 1u);
}

/// The greatest float below x, for finite x.
float nextDown(float x) { return -nextUp(-x); }
