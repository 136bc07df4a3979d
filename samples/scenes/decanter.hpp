// A decanter with what is in it and on it, in metres, standing on y = 0; and the sweep of paper behind it. With vertex normals.
#pragma once
#include "mesh.hpp"
#include "picture.hpp"

namespace samples {

Mesh decanter();

/// Reaches into the glass, as nested volumes are modelled.
Mesh decanterFilling();

/// A knob of brass over a plug that does not touch the neck. Has texture coordinates.
Mesh decanterStopper();

/// A ground that bends up into a wall, seamless. Its face is |x| <= halfWidth, y = 0 for z from -`depth` to `front`.
Mesh sweep(double halfWidth, double front, double depth, double height);

/// Of turned brass, along the turning: a normal map, and roughness in green with metallic in blue. Both repeat in u.
Picture brushedNormals(int width, int height);
Picture brushedSurface(int width, int height);

}  // namespace samples
