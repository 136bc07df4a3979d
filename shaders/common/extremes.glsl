// The extremes of two floats by their bits, in which drivers that guard min and max against NaN need one instruction instead of four. GLSL and
// C++ (tests/shader_source.hpp). Neither may be a NaN. Where both are negative the result is one of them, no matter which.

float maxByBits(float a, float b) { return intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b))); }
float minByBits(float a, float b) { return intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b))); }
