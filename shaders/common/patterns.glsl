// How checkers and textures repeat. GLSL and C++ (tests/shader_source.hpp).

/// Points this share of a cell before an edge count as past it: views that look along edges meet many points just on one, and
/// rounding must not draw lots for them.
const real CELL_EDGE = real(1.0 / 65536.0);

/// Whether the cells of size `scale` that hold p, on the two axes across the normal `ng`, have an even sum.
bool inEvenCell(vec3 p, vec3 ng, real scale) {
    vec3 cell = floor(p / scale + vec3(CELL_EDGE));
    vec3 a = abs(ng);
    real sum = a.x > a.y && a.x > a.z ? cell.y + cell.z : a.y > a.z ? cell.x + cell.z : cell.x + cell.y;
    return sum - real(2) * floor(sum * real(0.5)) == real(0);
}

/// How an image goes on beyond its rim.
const uint WRAP_CLAMP = 0u;
const uint WRAP_REPEAT = 1u;
const uint WRAP_MIRROR = 2u;

/// A texture coordinate brought to where its image lies: [0, 1], or [0, 2] where that is the image and its mirror image.
real wrapCoordinate(real u, uint wrap) {
    if (wrap == WRAP_CLAMP) return clamp(u, real(0), real(1));
    return wrap == WRAP_MIRROR ? u - real(2) * floor(u * real(0.5)) : u - floor(u);
}

/// The row or column 0..size-1 that stands in for number i.
int wrapTexel(int i, int size, uint wrap) {
    if (wrap == WRAP_CLAMP) return clamp(i, 0, size - 1);
    int period = wrap == WRAP_MIRROR ? 2 * size : size;
    int k = i - period * int(floor(real(i) / real(period)));
    return k < size ? k : period - 1 - k;
}
