// The names that make the physics files GLSL; tests/shader_source.hpp gives the same names in C++.
#define real float
#define PRECISE precise
#define UNROLL [[unroll]]
const float MACHINE_EPSILON = 5.9604644775390625e-8;  // 2^-24: half a unit in the last place of 1
#define PI 3.14159265358979323846
#define HALF_PI 1.57079632679489661923
#define INV_PI 0.31830988618379067154
#define INV_TWO_PI 0.15915494309189533577
