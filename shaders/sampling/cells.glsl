// The sphere of directions as cells, by which an environment is sampled: `columns` of equal width in longitude, `rows` of equal height in latitude
// from +Y down, in the coordinates of equirectUv. GLSL and C++ (tests/shader_source.hpp).

/// (1 - cos, sin) of the angle from +Y at share v of the way to -Y, v in [0,1/2]: exact near the pole, where cosines are not.
vec2 latitude(real v) {
    vec2 part = cosSinTurns(v * real(0.25));
    return vec2(real(2) * part.y * part.y, real(2) * part.x * part.y);
}

/// Height above the horizon's plane of a cell in row `row`: its solid angle is that times 2 pi / columns.
real cellHeight(uint row, uint rows) {
    vec2 middle = cosSinTurns((real(row) + real(0.5)) / real(rows) * real(0.5));
    vec2 part = cosSinTurns(real(0.25) / real(rows));
    return real(2) * middle.y * part.y;
}

/// Density per steradian of directions that are uniform in a cell, of probability 1.
real cellPdf(uint row, uint columns, uint rows) { return real(columns) * real(INV_TWO_PI) / cellHeight(row, rows); }

/// A direction uniform over the solid angle of a cell; `turns` is how far the environment is rotated.
vec3 directionInCell(uint column, uint row, uint columns, uint rows, real turns, vec2 u) {
    bool lower = real(2) * (real(row) + real(0.5)) > real(rows);  // mirrored to the upper half; a row across the horizon is cut below
    real top = real(lower ? rows - 1u - row : row) / real(rows);
    real bottom = top + real(1) / real(rows);
    real from = latitude(min(top, real(0.5))).x;
    real to = bottom > real(0.5) ? from + cellHeight(row, rows) : latitude(bottom).x;
    real h = from + (to - from) * u.y;
    real s = sqrt(max(h * (real(2) - h), real(0)));
    real longitude = (real(column) + u.x) / real(columns) - real(0.5) - turns;
    vec2 around = cosSinTurns(longitude - floor(longitude));
    return vec3(around.x * s, lower ? h - real(1) : real(1) - h, around.y * s);
}
