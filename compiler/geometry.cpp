#include "geometry.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <map>

#include "closed_surface.hpp"
#include "vertex_normals.hpp"

namespace minirtc {
namespace {

/// Coordinates end here, not at FLT_MAX: squared distances, areas of boxes and a GridRay (shaders/traverse/grid_box.glsl) must not overflow either.
constexpr double kLargestCoordinate = 1e18;

/// sin and cos that are exact at multiples of 90 degrees, so that axis-aligned shapes stay so.
glm::dvec2 cosSinDegrees(double degrees) {
    const double turn = std::remainder(degrees, 360.0);
    const double quarter = std::round(turn / 90.0);
    const double rest = glm::radians(turn - 90.0 * quarter);
    const double c = std::cos(rest), s = std::sin(rest);
    switch ((static_cast<int>(quarter) + 4) % 4) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

/// Rz * Ry * Rx: about X first.
glm::dmat3 rotation(const glm::dvec3& degrees) {
    const glm::dvec2 x = cosSinDegrees(degrees.x), y = cosSinDegrees(degrees.y), z = cosSinDegrees(degrees.z);
    const glm::dmat3 rx(1, 0, 0, 0, x.x, x.y, 0, -x.y, x.x);  // columns
    const glm::dmat3 ry(y.x, 0, -y.y, 0, 1, 0, y.y, 0, y.x);
    const glm::dmat3 rz(z.x, z.y, 0, -z.y, z.x, 0, 0, 0, 1);
    return rz * ry * rx;
}

/// A Transform ready to apply.
struct Placement {
    explicit Placement(const Transform& t)
        : rotate(rotation(t.rotate)),
          scale(t.scale),
          translate(t.translate),
          mirrored((t.scale.x < 0) != ((t.scale.y < 0) != (t.scale.z < 0))) {}

    glm::dvec3 point(const glm::dvec3& p) const { return rotate * (scale * p) + translate; }
    /// By the inverse transpose; not normalised. Scaled by the largest factor against overflow.
    glm::dvec3 normal(const glm::dvec3& n) const {
        const glm::dvec3 size = glm::abs(scale);
        return rotate * (n / (scale / std::max({size.x, size.y, size.z})));
    }

    glm::dmat3 rotate;
    glm::dvec3 scale, translate;
    bool mirrored;
};

glm::dvec3 normalizeOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

/// Twice the area along the normal; zero where the corners are on one line as far as double can tell, or where the area is under
/// the smallest normal float.
glm::dvec3 areaVector(const std::array<glm::vec3, 3>& p) {
    const glm::dvec3 a(p[0]), u = glm::dvec3(p[1]) - a, v = glm::dvec3(p[2]) - a;
    const glm::dvec3 area = glm::cross(u, v);
    constexpr double kRounding = 4e-16;
    return glm::length(area) <= std::max(kRounding * glm::length(u) * glm::length(v), double{FLT_MIN}) ? glm::dvec3(0) : area;
}

float largestCoordinate(const std::array<glm::vec3, 3>& p) {
    float largest = 0;
    for (const glm::vec3& v : p) largest = std::max({largest, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    return largest;
}

double shortestEdge(const std::array<glm::vec3, 3>& p) {
    const auto edge = [&](int a, int b) { return glm::length(glm::dvec3(p[b]) - glm::dvec3(p[a])); };
    return std::min({edge(0, 1), edge(1, 2), edge(2, 0)});
}

/// True where something of this size is under 64 steps of float at that distance from the origin: its shape is rounding noise.
bool isLostInRounding(double size, float distance) {
    const double ulp = std::nextafter(distance, FLT_MAX) - distance;
    return size < 64 * ulp;
}

/// Rounds; denormals become 0 here, because devices may flush them or not.
glm::vec3 toFloat(const glm::dvec3& v) {
    glm::vec3 f(v);
    for (int i = 0; i < 3; ++i)
        if (std::fabs(f[i]) < FLT_MIN) f[i] = 0;
    return f;
}

struct WorldBounds {
    glm::dvec3 min{DBL_MAX}, max{-DBL_MAX};
    void grow(const glm::dvec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
};

class Flattener {
public:
    Flattener(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

    Geometry run() {
        for (const Object& object : scene_.objects) measure(object);
        if (bounds_.min.x > bounds_.max.x) throw Error({scene_.path}, "there is nothing to render", "add an object with faces");
        out_.origin = 0.5 * (bounds_.min + bounds_.max);
        out_.primitives.reserve(primitiveCount_);
        for (const Object& object : scene_.objects) add(object);
        if (out_.primitives.empty())
            throw Error({scene_.path}, "no triangle of the scene has an area", "check the meshes and their scale");
        measureResult();
        return std::move(out_);
    }

private:
    // First pass: bounds in world space.

    void measure(const Object& object) {
        if (object.shape == ShapeType::mesh) {
            for (const Transform& transform : object.instances) measureMesh(object, Placement(transform));
            return;
        }
        std::vector<glm::dvec3> points;
        if (object.shape == ShapeType::sphere) {
            points = {object.sphere.center - object.sphere.radius, object.sphere.center + object.sphere.radius};
        } else {
            const Rectangle& r = object.rectangle;
            points = {r.origin, r.origin + r.u, r.origin + r.v, r.origin + r.u + r.v};
        }
        for (const glm::dvec3& p : points) grow(p, object.location, object);
        primitiveCount_ += 2;
    }

    void measureMesh(const Object& object, const Placement& placement) {
        const Mesh& mesh = scene_.meshes[object.mesh];
        world_.clear();
        for (const glm::dvec3& p : mesh.positions) world_.push_back(placement.point(p));
        for (const Face& face : mesh.faces)
            for (const Corner& corner : face.corners) grow(world_[corner.position], {mesh.path, face.line}, object);
        primitiveCount_ += mesh.faces.size();
    }

    void grow(const glm::dvec3& p, const SourceLocation& location, const Object& object) {
        const glm::dvec3 size = glm::abs(p);
        // Written so that NaN fails too.
        if (!(size.x <= kLargestCoordinate && size.y <= kLargestCoordinate && size.z <= kLargestCoordinate))
            throw Error(location,
                        "a coordinate of " + object.name + " (object in line " + std::to_string(object.location.line) +
                            " of the scene) is over 1e18 in world space",
                        "single precision cannot hold it; scale it down");
        bounds_.grow(p);
    }

    // Second pass: primitives relative to the origin.

    void add(const Object& object) {
        lostInRounding_ = false, dropped_ = 0, seen_ = 0;
        for (size_t i = 0; i < object.instances.size(); ++i) {
            const bool several = object.instances.size() > 1;
            instanceName_ = object.name + (several ? "[" + std::to_string(i) + "]" : "");
            instanceBodies_.clear();
            if (object.shape == ShapeType::mesh) addMesh(object, Placement(object.instances[i]));
            keepSlivers();
        }
        if (object.shape == ShapeType::sphere) addSphere(object);
        if (object.shape == ShapeType::rectangle) addRectangle(object);
        keepSlivers();
        warn(object);
    }

    glm::vec3 recentre(const glm::dvec3& world) const { return toFloat(world - out_.origin); }

    /// The body of the instance at hand that faces of this material belong to.
    uint32_t bodyOf(const Object& object, uint32_t material) {
        const uint32_t bounded = boundsVolume(scene_.materials[material]) ? material : kNone;
        const auto [entry, isNew] = instanceBodies_.emplace(bounded, static_cast<uint32_t>(out_.bodies.size()));
        if (isNew) {
            const bool ownMaterials = object.material == kNone && bounded != kNone;
            const std::string suffix = ownMaterials ? " (" + scene_.materials[material].name + ")" : "";
            out_.bodies.push_back({instanceName_ + suffix, object.location, bounded, object.priority, object.material == kNone});
        }
        return entry->second;
    }

    bool hasTexture(uint32_t index) const {
        const Material& m = scene_.materials[index];
        return m.checker ? isTextured(scene_.materials[m.checkerA]) || isTextured(scene_.materials[m.checkerB]) : isTextured(m);
    }

    void addSphere(const Object& object) {
        Primitive sphere;
        sphere.isSphere = true;
        const float radius = static_cast<float>(object.sphere.radius);
        sphere.p = {recentre(object.sphere.center), glm::vec3(radius, 0, 0), glm::vec3(0)};
        sphere.material = object.material;
        sphere.body = bodyOf(object, object.material);
        noteSize(radius, largestCoordinate({sphere.p[0], sphere.p[0], sphere.p[0]}));
        out_.primitives.push_back(sphere);
    }

    void addRectangle(const Object& object) {
        const Rectangle& r = object.rectangle;
        const glm::vec3 p[4] = {recentre(r.origin), recentre(r.origin + r.u), recentre(r.origin + r.u + r.v),
                                recentre(r.origin + r.v)};
        const glm::vec2 uv[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};  // row 0 of a texture is at the end of v
        const glm::dvec3 flat(0);
        for (const auto& [a, b, c] : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}})
            addTriangle({p[a], p[b], p[c]}, {flat, flat, flat}, {uv[a], uv[b], uv[c]}, object, object.material);
    }

    void addMesh(const Object& object, const Placement& placement) {
        const Mesh& mesh = scene_.meshes[object.mesh];
        world_.clear();
        local_.clear();
        for (const glm::dvec3& p : mesh.positions) {
            world_.push_back(placement.point(p) - out_.origin);
            local_.push_back(toFloat(world_.back()));
        }
        const bool average = object.smooth.value_or(false) && lacksNormals(mesh);
        const VertexNormals averaged = average ? averageNormals(mesh, world_, local_) : VertexNormals{};
        const bool smooth = object.smooth.value_or(true);

        for (const Face& face : mesh.faces) {
            std::array<Corner, 3> corners = face.corners;
            if (placement.mirrored) std::swap(corners[1], corners[2]);
            std::array<glm::vec3, 3> p;
            std::array<glm::dvec3, 3> normals;
            std::array<glm::vec2, 3> uvs;
            for (int i = 0; i < 3; ++i) {
                const Corner& corner = corners[i];
                p[i] = local_[corner.position];
                uvs[i] = corner.uv == kNone ? glm::vec2(0) : mesh.uvs[corner.uv];
                normals[i] = glm::dvec3(0);
                if (smooth && corner.normal != kNone) normals[i] = normalizeOrZero(placement.normal(mesh.normals[corner.normal]));
                if (average && normals[i] == glm::dvec3(0))
                    normals[i] = averaged.at(corner.position) * (placement.mirrored ? -1.0 : 1.0);
            }
            addTriangle(p, normals, uvs, object, object.material != kNone ? object.material : mesh.materials[face.material]);
        }
    }

    static bool lacksNormals(const Mesh& mesh) {
        for (const Face& face : mesh.faces)
            for (const Corner& corner : face.corners)
                if (corner.normal == kNone || mesh.normals[corner.normal] == glm::vec3(0)) return true;
        return false;
    }

    /// A zero normal stands for the geometric one.
    void addTriangle(const std::array<glm::vec3, 3>& p, std::array<glm::dvec3, 3> normals, const std::array<glm::vec2, 3>& uvs,
                     const Object& object, uint32_t material) {
        ++seen_;
        const glm::dvec3 area = areaVector(p);
        if (area == glm::dvec3(0)) {
            ++dropped_;
            drop(p, material);
            return;
        }
        noteSize(shortestEdge(p), largestCoordinate(p));
        const glm::dvec3 ng = glm::normalize(area);
        const bool bent = makeConsistent(normals, ng);

        Primitive triangle;
        triangle.p = p;
        triangle.material = material;
        triangle.body = bodyOf(object, material);
        if (bent || hasTexture(material)) {
            triangle.corners = static_cast<uint32_t>(out_.corners.size());
            out_.corners.push_back({{glm::vec3(normals[0]), glm::vec3(normals[1]), glm::vec3(normals[2])}, uvs});
        }
        out_.anySmooth = out_.anySmooth || bent;
        out_.primitives.push_back(triangle);
    }

    /// Faces without area make no body.
    void drop(const std::array<glm::vec3, 3>& p, uint32_t material) {
        Primitive sliver;
        sliver.p = p;
        sliver.material = material;
        if (boundsVolume(scene_.materials[material])) instanceSlivers_.push_back(sliver);
    }

    void keepSlivers() {
        for (Primitive& sliver : instanceSlivers_) {
            const auto body = instanceBodies_.find(sliver.material);
            if (body == instanceBodies_.end()) continue;
            sliver.body = body->second;
            out_.slivers.push_back(sliver);
        }
        instanceSlivers_.clear();
    }

    /// Makes all normals unit vectors on the front side of the face; true when some differ from its own. A face whose normals are
    /// all on the back was wound the other way round than its normals say: they are turned. A single one is replaced.
    static bool makeConsistent(std::array<glm::dvec3, 3>& normals, const glm::dvec3& ng) {
        const auto behind = [&](const glm::dvec3& n) { return glm::dot(n, ng) < 0; };
        if (behind(normals[0]) && behind(normals[1]) && behind(normals[2]))
            for (glm::dvec3& n : normals) n = -n;
        constexpr double kSame = 1e-6;
        bool bent = false;
        for (glm::dvec3& n : normals) {
            if (!(glm::dot(n, ng) > 0) || glm::length(n - ng) < kSame) n = ng;
            bent = bent || n != ng;
        }
        return bent;
    }

    void noteSize(double size, float distance) { lostInRounding_ = lostInRounding_ || isLostInRounding(size, distance); }

    void warn(const Object& object) {
        out_.degenerateTriangles += dropped_;
        if (dropped_ > 0)
            diagnostics_.warn(
                object.location,
                std::to_string(dropped_) + " of " + std::to_string(seen_) + " triangles of " + object.name + " have no area",
                "they are left out");
        if (lostInRounding_)
            diagnostics_.warn(object.location,
                              object.name + " has features under 64 float steps at their distance from the scene's centre",
                              "move the scene's parts closer together or make the features larger");
    }

    void measureResult() {
        Bounds bounds;
        for (const Primitive& primitive : out_.primitives) bounds.grow(primitive);
        out_.boundsMin = bounds.min, out_.boundsMax = bounds.max;
    }

    const Scene& scene_;
    Diagnostics& diagnostics_;
    Geometry out_;
    WorldBounds bounds_;
    size_t primitiveCount_ = 0;
    std::vector<glm::dvec3> world_;                // of the mesh instance at hand
    std::vector<glm::vec3> local_;                 // the same in float, relative to the origin
    std::string instanceName_;                     // of the instance at hand
    std::map<uint32_t, uint32_t> instanceBodies_;  // by the material that they bound
    std::vector<Primitive> instanceSlivers_;
    // Of the object at hand:
    bool lostInRounding_ = false;
    uint64_t dropped_ = 0;
    uint64_t seen_ = 0;
};

}  // namespace

void Bounds::grow(const Primitive& primitive) {
    if (primitive.isSphere) {
        min = glm::min(min, primitive.p[0] - primitive.p[1].x), max = glm::max(max, primitive.p[0] + primitive.p[1].x);
        return;
    }
    for (const glm::vec3& p : primitive.p) min = glm::min(min, p), max = glm::max(max, p);
}

std::vector<Bounds> bodyBounds(const Geometry& geometry) {
    std::vector<Bounds> bounds(geometry.bodies.size());
    for (const Primitive& primitive : geometry.primitives) bounds[primitive.body].grow(primitive);
    return bounds;
}

Geometry flatten(const Scene& scene, Diagnostics& diagnostics) {
    return turnOutward(Flattener(scene, diagnostics).run(), diagnostics);
}

}  // namespace minirtc
