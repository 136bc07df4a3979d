// All shapes in world space, recentred, in float: what the BVH is built over and the blob stores.
#pragma once
#include "scene.hpp"

namespace minirtc {

/// A triangle, or a sphere when `isSphere` (p[0] its centre, p[1].x its radius). Positions are relative to Geometry::origin.
struct Primitive {
    std::array<glm::vec3, 3> p;
    bool isSphere = false;
    uint32_t material = 0;     // index into Scene::materials
    uint32_t body = 0;         // index into Geometry::bodies
    uint32_t corners = kNone;  // index into Geometry::corners; kNone: flat and untextured
};

/// Vertex attributes of a triangle that is smooth or textured.
struct CornerAttributes {
    std::array<glm::vec3, 3> normals;  // unit; the geometric normal where the triangle is flat
    std::array<glm::vec2, 3> uvs;
};

/// What a ray can be inside of, or bounce off: an instance of an object. Its faces of each transmissive material are a body of their own.
struct Body {
    std::string name;           // for messages
    SourceLocation location;    // of the object in the scene file
    uint32_t material = kNone;  // of a volume; kNone where the body bounds none
    int priority = 0;
    bool isFromMtl = false;  // its material is one of the mesh's own .mtl
    bool isVolume() const { return material != kNone; }
};

struct Geometry {
    glm::dvec3 origin{0};  // world position of scene-space zero: the centre of the bounds
    glm::vec3 boundsMin{0};
    glm::vec3 boundsMax{0};
    std::vector<Primitive> primitives;
    std::vector<CornerAttributes> corners;
    std::vector<Body> bodies;
    bool anySmooth = false;            // some corner normal differs from its geometric normal
    uint64_t degenerateTriangles = 0;  // dropped: zero area after rounding to float
    std::vector<Primitive> slivers;    // those of them that belong to volumes: edges of others may meet only through them
};

/// The box around a body's primitives, relative to Geometry::origin; min > max where it has none.
struct Bounds {
    glm::vec3 min{std::numeric_limits<float>::max()};
    glm::vec3 max{-std::numeric_limits<float>::max()};
    void grow(const Primitive& primitive);
};

/// One a body.
std::vector<Bounds> bodyBounds(const Geometry& geometry);

/// Bakes transforms and vertex normals. A negative scale keeps the orientation (the winding is flipped back).
/// Missing normals of a smooth object are averaged per position, weighted by the angle at the vertex (Thuermer & Wuethrich 1998).
/// Closed volumes that are inside out are turned round, with a warning.
/// Throws Error where a coordinate is not finite in float or nothing is left to draw.
Geometry flatten(const Scene& scene, Diagnostics& diagnostics);

}  // namespace minirtc
