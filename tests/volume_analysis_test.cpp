#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "closed_mesh.hpp"
#include "closed_surface.hpp"
#include "random.hpp"
#include "support.hpp"
#include "volume_overlap.hpp"
#include "volumes.hpp"

using namespace minirtc;
using test::ClosedMesh;

namespace {

constexpr uint32_t kWhite = 0, kGlass = 1, kThin = 2;

/// Objects one by one, in lines 1, 2, ... of a file; materials white, glass and thin glass.
struct Builder {
    Scene scene;
    Diagnostics diagnostics;
    Geometry geometry;

    Builder() {
        scene.path = "s.json";
        scene.materials.resize(3);
        scene.materials[kGlass].transmit = scene.materials[kThin].transmit = glm::vec3(1);
        scene.materials[kThin].thin = true;
    }

    Object& add(const std::string& name, uint32_t material) {
        Object object;
        object.name = name;
        object.location = {"s.json", static_cast<int>(scene.objects.size()) + 1, 1};
        object.material = material;
        scene.objects.push_back(object);
        return scene.objects.back();
    }

    Object& mesh(const std::string& name, const ClosedMesh& shape, const Transform& placement = {}, uint32_t material = kGlass) {
        Mesh mesh;
        mesh.path = name;
        mesh.positions = shape.positions;
        for (const auto& corners : shape.faces) {
            Face face;
            for (int i = 0; i < 3; ++i) face.corners[i].position = corners[i];
            mesh.faces.push_back(face);
        }
        scene.meshes.push_back(mesh);
        Object& object = add(name, material);
        object.mesh = static_cast<uint32_t>(scene.meshes.size() - 1);
        object.instances = {placement};
        return object;
    }

    Object& sphere(const std::string& name, const glm::dvec3& center, double radius, uint32_t material = kGlass) {
        Object& object = add(name, material);
        object.shape = ShapeType::sphere;
        object.sphere = {center, radius};
        return object;
    }

    Object& rectangle(const std::string& name, const Rectangle& shape, uint32_t material) {
        Object& object = add(name, material);
        object.shape = ShapeType::rectangle;
        object.rectangle = shape;
        return object;
    }

    Volumes volumes() {
        diagnostics = {};
        geometry = flatten(scene, diagnostics);
        return analyseVolumes(scene, geometry, diagnostics);
    }

    std::string error() {
        try {
            volumes();
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }

    /// "b over a: reason; ..."
    std::string displacements(const Volumes& volumes) const {
        std::string text;
        for (const Displacement& pair : volumes.displacements)
            text += geometry.bodies[pair.above].name + " over " + geometry.bodies[pair.below].name + ": " + pair.reason + "; ";
        return text;
    }

    std::string order(const Volumes& volumes) const {
        std::string text;
        for (const uint32_t body : volumes.order) text += geometry.bodies[body].name + " ";
        return text;
    }
};

/// The box from 0 to `size`; two triangles a side.
ClosedMesh box(const glm::dvec3& size = glm::dvec3(1)) {
    ClosedMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.push_back(size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2));
    const std::array<uint32_t, 4> sides[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : sides) mesh.faces.insert(mesh.faces.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
    return mesh;
}

/// The box from 0 to 1 with its edges along these vectors.
ClosedMesh sheared(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
    ClosedMesh mesh = box();
    for (glm::dvec3& p : mesh.positions) p = p.x * x + p.y * y + p.z * z;
    return mesh;
}

ClosedMesh flipped(ClosedMesh mesh) {
    for (auto& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

/// Both in one mesh; the second one scaled and moved.
ClosedMesh both(ClosedMesh mesh, const ClosedMesh& other, double scale, const glm::dvec3& offset) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : other.positions) mesh.positions.push_back(p * scale + offset);
    for (const auto& f : other.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    return mesh;
}

Transform at(const glm::dvec3& translate, const glm::dvec3& scale = glm::dvec3(1), const glm::dvec3& rotate = glm::dvec3(0)) {
    return {scale, rotate, translate};
}

/// Two convex meshes: whether all normals of faces and products of edges leave them apart (separating axis theorem).
bool isSeparated(const Geometry& geometry) {
    std::vector<glm::dvec3> edges[2], axes;
    for (const Primitive& t : geometry.primitives) {
        const glm::dvec3 u(t.p[1] - t.p[0]), v(t.p[2] - t.p[0]);
        edges[t.body].insert(edges[t.body].end(), {u, v});
        axes.push_back(glm::cross(u, v));
    }
    for (const glm::dvec3& u : edges[0])
        for (const glm::dvec3& v : edges[1]) axes.push_back(glm::cross(u, v));
    return std::any_of(axes.begin(), axes.end(), [&](const glm::dvec3& axis) {
        double lo[2] = {1e300, 1e300}, hi[2] = {-1e300, -1e300};
        for (const Primitive& t : geometry.primitives) {
            for (const glm::vec3& p : t.p) {
                lo[t.body] = std::min(lo[t.body], glm::dot(axis, glm::dvec3(p)));
                hi[t.body] = std::max(hi[t.body], glm::dot(axis, glm::dvec3(p)));
            }
        }
        return hi[0] < lo[1] || hi[1] < lo[0];
    });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// How many warnings hold the text.
long count(const Diagnostics& diagnostics, const std::string& part) {
    return std::count_if(diagnostics.warnings.begin(), diagnostics.warnings.end(),
                         [&](const std::string& warning) { return contains(warning, part); });
}

std::string all(const Diagnostics& diagnostics) {
    std::string text;
    for (const std::string& warning : diagnostics.warnings) text += warning + "\n";
    return text;
}

}  // namespace

TEST_CASE("a scene without volumes has none, and every body in its place") {
    Builder builder;
    builder.mesh("a", box(), {}, kWhite);
    builder.rectangle("pane", {}, kThin);
    const Volumes volumes = builder.volumes();
    CHECK(volumes.count == 0);
    CHECK(volumes.capacity == 0);
    CHECK(builder.order(volumes) == "a pane ");
    CHECK((volumes.overlap + volumes.content + volumes.selfOverlap).empty());
}

TEST_CASE("a mesh that is not closed is an error with the number of open edges and where they are") {
    Builder builder;
    ClosedMesh open = box();
    open.faces.resize(10);  // without the side z = 1
    builder.mesh("open.obj", open, at({10, 20, 30}));
    CHECK(builder.error() ==
          "s.json:1:1: open.obj transmits light but is not closed: 4 edges with a face on one side only: (10, 20, 31) to (10, "
          "21, 31), "
          "(11, 21, 31) to (11, 20, 31), (11, 20, 31) to (10, 20, 31), ...; close the mesh, or give the material \"thin\": true");
    builder.scene.objects[0].material = kThin;
    CHECK(builder.error() == "");
}

TEST_CASE("of an open mesh with a material of its .mtl the advice is one that can be followed there") {
    Builder builder;
    ClosedMesh open = box();
    open.faces.resize(10);
    builder.mesh("open.obj", open, {}, kNone);
    builder.scene.meshes[0].materials = {kGlass};
    for (Face& face : builder.scene.meshes[0].faces) face.material = 0;
    CHECK(contains(builder.error(),
                   "; close the mesh, or make its material a thin sheet: 'Ni 1' in the .mtl file, or name one with "
                   "\"thin\": true in the scene file"));
    builder.scene.meshes[0].materials = {kThin};
    CHECK(builder.error() == "");
}

TEST_CASE("a rectangle of glass is open") {
    Builder builder;
    builder.rectangle("pane", {}, kGlass);
    CHECK(contains(builder.error(), "pane transmits light but is not closed: 4 edges"));
}

TEST_CASE("a face that is wound the other way round is an error of its own") {
    Builder builder;
    ClosedMesh mesh = box();
    std::swap(mesh.faces[3][1], mesh.faces[3][2]);
    builder.mesh("bent.obj", mesh);
    CHECK(contains(builder.error(), "bent.obj transmits light but its faces do not agree on where its inside is: 3 edges along"));
}

TEST_CASE("an edge of three faces is an error, and one of four that balance is not") {
    Builder builder;
    SUBCASE("three") {
        ClosedMesh mesh = box();
        mesh.positions.push_back({0.5, -1, 2});
        mesh.faces.push_back({4, 5, 8});
        builder.mesh("fin.obj", mesh);
        CHECK(contains(builder.error(), "fin.obj transmits light but is not closed: 2 edges"));
    }
    SUBCASE("four: two boxes that meet along an edge") {
        builder.mesh("pair.obj", both(box(), box(), 1, {1, 1, 0}));
        const Volumes volumes = builder.volumes();
        CHECK(volumes.count == 1);
        CHECK(volumes.selfOverlap.empty());
    }
}

TEST_CASE("vertices count as one where their positions are the same, however many there are") {
    Builder builder;
    const ClosedMesh ball = test::ball(2);
    ClosedMesh loose;
    for (const auto& face : ball.faces) {
        const auto first = static_cast<uint32_t>(loose.positions.size());
        for (const uint32_t i : face) loose.positions.push_back(ball.positions[i]);
        loose.faces.push_back({first, first + 1, first + 2});
    }
    builder.mesh("loose.obj", loose);
    CHECK(builder.error() == "");
    CHECK(builder.volumes().count == 1);
}

TEST_CASE("a triangle without area may close a mesh") {
    Builder builder;
    ClosedMesh mesh = box({2, 2, 2});
    mesh.positions.push_back({1, 1, 0});  // on the diagonal of the side z = 0, whose first triangle is cut there
    auto cut = std::find(mesh.faces.begin(), mesh.faces.end(), std::array<uint32_t, 3>{0, 2, 3});
    REQUIRE(cut != mesh.faces.end());
    *cut = {0, 2, 8};
    mesh.faces.push_back({2, 3, 8});
    builder.mesh("box.obj", mesh);
    CHECK(contains(builder.error(), "not closed: 3 edges"));
    builder.scene.meshes[0].faces.push_back(builder.scene.meshes[0].faces[0]);
    const uint32_t sliver[3] = {0, 8, 3};
    for (int i = 0; i < 3; ++i) builder.scene.meshes[0].faces.back().corners[i].position = sliver[i];
    CHECK(builder.error() == "");
    CHECK(builder.geometry.degenerateTriangles == 1);
}

TEST_CASE("a mesh that is inside out is turned round, with its normals") {
    Builder builder;
    builder.mesh("ball.obj", flipped(test::ball(2)), at({5, 0, 0})).smooth = true;
    const Volumes volumes = builder.volumes();
    CHECK(volumes.count == 1);
    REQUIRE(builder.diagnostics.warnings.size() == 1);
    CHECK(builder.diagnostics.warnings[0] ==
          "s.json:1:1: warning: ball.obj is inside out: its faces run clockwise as seen from outside; they are turned round");
    for (const Primitive& t : builder.geometry.primitives) {
        const glm::vec3 ng = glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
        CHECK(glm::dot(ng, t.p[0]) > 0);
        for (const glm::vec3& n : builder.geometry.corners[t.corners].normals) CHECK(glm::dot(n, ng) > 0);
    }
}

TEST_CASE("what does not transmit is not turned round") {
    Builder builder;
    builder.mesh("ball.obj", flipped(test::ball(2)), {}, kWhite);
    builder.volumes();
    CHECK(builder.diagnostics.warnings.empty());
}

TEST_CASE("a negative scale keeps a mesh closed and outward") {
    Builder builder;
    builder.mesh("torus.obj", test::torus(24, 12), at({1, 2, 3}, {-1, 2, 1}, {10, 20, 30}));
    CHECK(builder.volumes().count == 1);
    CHECK(all(builder.diagnostics) == "");
}

TEST_CASE("the size of a mesh is its volume, near the origin and far from it") {
    for (const double offset : {0.0, 1000.0}) {
        Builder builder;
        builder.mesh("box.obj", box({2, 3, 4}), at(glm::dvec3(offset)));
        builder.volumes();
        const ClosedSurface closed = requireClosed(builder.geometry.primitives, {}, builder.geometry.bodies[0], {});
        CHECK(closed.size == doctest::Approx(24));
        CHECK(closed.shells.size() == 1);
    }
}

TEST_CASE("spheres: one in the other, apart, touching, crossing") {
    Builder builder;
    builder.sphere("big", {0, 0, 0}, 2);
    SUBCASE("inside") {
        builder.sphere("small", {0.5, 0, 0}, 1);
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes) == "small over big: it lies inside; ");
        CHECK(volumes.overlap == "small in big");
        CHECK(builder.order(volumes) == "big small ");
        CHECK(volumes.capacity == 2);
    }
    SUBCASE("inside, listed first") {
        std::swap(builder.scene.objects[0].sphere, builder.sphere("second", {0.5, 0, 0}, 1).sphere);
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes) == "big over second: it lies inside; ");
        CHECK(builder.order(volumes) == "second big ");
    }
    SUBCASE("inside and touching") {
        builder.sphere("small", {1, 0, 0}, 1);
        CHECK(builder.displacements(builder.volumes()) == "small over big: it lies inside; ");
    }
    SUBCASE("apart") {
        builder.sphere("small", {2, 2, 2}, 1);
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes).empty());
        CHECK(volumes.overlap.empty());
        CHECK(volumes.capacity == 1);
    }
    SUBCASE("touching from outside") {
        builder.sphere("small", {3, 0, 0}, 1);
        CHECK(builder.displacements(builder.volumes()).empty());
    }
    SUBCASE("crossing") {
        builder.sphere("small", {2, 0, 0}, 1);
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes) == "small over big: it is smaller (4.19 m^3 against 33.5 m^3); ");
        CHECK(volumes.overlap == "big overlaps small");
    }
    SUBCASE("the same twice") {
        builder.sphere("twin", {0, 0, 0}, 2);
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes) == "twin over big: it comes later in the scene (both have 33.5 m^3); ");
        CHECK(count(builder.diagnostics, "lie on each other") == 1);
        CHECK(count(builder.diagnostics, "of like size") == 1);
    }
}

TEST_CASE("a sphere and a mesh") {
    Builder builder;
    builder.mesh("cube", box({2, 2, 2}));
    SUBCASE("sphere inside") {
        builder.sphere("ball", {1, 1, 1}, 0.9);
        CHECK(builder.displacements(builder.volumes()) == "ball over cube: it lies inside; ");
    }
    SUBCASE("sphere inside, touching every side") {
        builder.sphere("ball", {1, 1, 1}, 1);
        CHECK(builder.displacements(builder.volumes()) == "ball over cube: it lies inside; ");
    }
    SUBCASE("mesh inside") {
        builder.sphere("ball", {1, 1, 1}, 1.8);
        CHECK(builder.displacements(builder.volumes()) == "cube over ball: it lies inside; ");
    }
    SUBCASE("crossing") {
        builder.sphere("ball", {2, 1, 1}, 0.1);
        CHECK(builder.displacements(builder.volumes()) == "ball over cube: it is smaller (4.19 l against 8 m^3); ");
    }
    SUBCASE("through the middle of a face, no vertex in it") {
        builder.sphere("ball", {1.2, 0.7, 2.05}, 0.1);
        CHECK(builder.volumes().displacements.size() == 1);
    }
    SUBCASE("touching from outside") {
        builder.sphere("ball", {1.2, 0.7, 2.5}, 0.5);
        CHECK(builder.volumes().displacements.empty());
    }
    SUBCASE("in the box around it, but not in it") {
        builder.scene.objects.clear();
        builder.mesh("torus", test::torus(32, 16));
        builder.sphere("ball", {0, 0, 0}, 0.3);
        CHECK(builder.volumes().displacements.empty());
    }
}

TEST_CASE("a mesh and a mesh") {
    Builder builder;
    SUBCASE("inside") {
        builder.mesh("outer", test::ball(3));
        builder.mesh("inner", box(), at({-0.2, -0.2, -0.2}, glm::dvec3(0.4)));
        CHECK(builder.displacements(builder.volumes()) == "inner over outer: it lies inside; ");
    }
    SUBCASE("inside, close by all around") {
        builder.mesh("outer", test::ball(4));
        builder.mesh("inner", test::ball(4), at({}, glm::dvec3(0.999)));
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes) == "inner over outer: it lies inside; ");
        CHECK(all(builder.diagnostics) == "");
    }
    SUBCASE("crossing") {
        builder.mesh("a", box());
        builder.mesh("b", test::ball(2), at({1, 0.9, 0.8}, glm::dvec3(0.1)));
        CHECK(builder.displacements(builder.volumes()) == "b over a: it is smaller (3.82 l against 1 m^3); ");
    }
    SUBCASE("only an edge of one goes through the other") {
        builder.mesh("plate", box({10, 10, 0.1}));
        builder.mesh("needle", box({0.1, 0.1, 10}), at({3.33, 4.44, -5}));
        CHECK(builder.volumes().overlap == "plate overlaps needle");
    }
    SUBCASE("edges meet diagonals: a bar through the middle of a cube") {
        builder.mesh("cube", box({2, 2, 2}));
        builder.mesh("bar", box({1, 1, 4}), at({0.5, 0.5, -1}));
        CHECK(builder.displacements(builder.volumes()) == "bar over cube: it is smaller (4 m^3 against 8 m^3); ");
    }
    SUBCASE("flush: a common part with faces in the same planes") {
        builder.mesh("a", box({2, 1, 1}));
        builder.mesh("b", box({3, 1, 1}), at({1, 0, 0}));
        CHECK(builder.displacements(builder.volumes()) == "a over b: it is smaller (2 m^3 against 3 m^3); ");
    }
    SUBCASE("one half in the other with all edges on its surface") {
        builder.mesh("water", box({4, 2, 4}));
        ClosedMesh buoy = test::ball(3);  // has vertices at y = 0, and no edge through it
        builder.mesh("buoy", buoy, at({2, 2, 2}));
        CHECK(builder.displacements(builder.volumes()) == "buoy over water: it is smaller (4.09 m^3 against 32 m^3); ");
    }
    SUBCASE("interlocked rings") {
        builder.mesh("a", test::torus(32, 16));
        builder.mesh("b", test::torus(32, 16), at({0.7, 0, 0}, glm::dvec3(0.3), {90, 0, 0}));
        builder.mesh("c", test::torus(32, 16), at({3, 0, 0}, glm::dvec3(1), {90, 0, 0}));
        CHECK(builder.order(builder.volumes()) == "a c b ");
    }
}

TEST_CASE("boxes that touch do not overlap, but their common faces are warned of") {
    Builder builder;
    builder.mesh("a", box());
    SUBCASE("whole faces") {
        builder.mesh("b", box(), at({1, 0, 0}));
    }
    SUBCASE("like bricks") {
        builder.mesh("b", box({1.5, 1, 1}), at({1, 0.5, 0}));
    }
    SUBCASE("a small one on a large one") {
        builder.mesh("b", box({0.25, 0.25, 0.25}), at({0.3, 1, 0.6}));
    }
    const Volumes volumes = builder.volumes();
    CHECK(builder.displacements(volumes).empty());
    CHECK(volumes.capacity == 1);
    CHECK(count(builder.diagnostics, "faces of a and b lie on each other") == 1);
    CHECK(builder.diagnostics.warnings.size() == 1);
}

TEST_CASE("boxes that touch along an edge or at a corner do not overlap, and nothing is said") {
    Builder builder;
    builder.mesh("a", box());
    SUBCASE("edges") {
        builder.mesh("b", box(), at({1, 1, 0.3}));
    }
    SUBCASE("crossed edges") {
        builder.scene.objects.clear();
        builder.mesh("a", sheared({1, 0, 0}, {0, 1, -1}, {0, 1, 1}));
        builder.mesh("b", sheared({1, 1, 0}, {-1, 1, 0}, {0, 0, 1}), at({0.5, 2, -0.5}));
    }
    SUBCASE("corner") {
        builder.mesh("b", box(), at({1, 1, 1}));
    }
    CHECK(builder.displacements(builder.volumes()).empty());
    CHECK(all(builder.diagnostics) == "");
}

TEST_CASE("faces on each other, and overlaps that are too thin") {
    Builder builder;
    builder.mesh("cup", box({2, 2, 2}));
    const std::string warning = "faces of cup and drink lie on each other";
    SUBCASE("liquid exactly on the wall") {
        builder.mesh("drink", box({1, 1, 1}), at({0.5, 0.5, 0}));
        CHECK(builder.volumes().overlap == "cup overlaps drink");
        CHECK(count(builder.diagnostics, warning) == 1);
    }
    SUBCASE("one step of float away") {
        builder.mesh("drink", box({1, 1, 1}), at({0.5, 0.5, 1 - 1e-7}));
        builder.volumes();
        CHECK(count(builder.diagnostics, warning) == 1);
    }
    SUBCASE("overlapping by one step of float") {
        builder.mesh("drink", box({1, 1, 1}), at({0.5, 0.5, 2 - 2.4e-7}));
        CHECK(builder.volumes().overlap == "cup overlaps drink");
        CHECK(count(builder.diagnostics, warning) == 1);
        CHECK(contains(all(builder.diagnostics), "let the two overlap by more than 1.3e-06 m"));
    }
    SUBCASE("overlapping enough") {
        builder.mesh("drink", box({1, 1, 1}), at({0.5, 0.5, 2 - 1e-5}));
        CHECK(builder.volumes().overlap == "cup overlaps drink");
        CHECK(all(builder.diagnostics) == "");
    }
}

TEST_CASE("glass that stands exactly on something opaque is warned of, with what to do") {
    Builder builder;
    const Rectangle table{{-5, 0, -5}, {0, 0, 20}, {20, 0, 0}};
    const std::string warning = "faces of glass and table lie on each other";
    const auto stand = [&](double height, const Rectangle& on) {
        builder.rectangle("table", on, kWhite);
        builder.mesh("glass", box(), at({0, height, 0}));
        return builder.volumes().content;
    };
    SUBCASE("on it") {
        CHECK(stand(0, table) == "table in glass");  // rays keep track: what lies on the surface may be met first
        CHECK(all(builder.diagnostics) ==
              "s.json:2:1: warning: faces of glass and table lie on each other, or nearer than rounding can tell: a ray may pass "
              "over one of them; move one so that they are more than 8.8e-06 m apart, or overlap by more\n");
    }
    SUBCASE("on its back") {
        stand(0, {table.origin, table.v, table.u});
        CHECK(count(builder.diagnostics, warning) == 1);
    }
    SUBCASE("nearly on it") {
        stand(2e-6, table);
        CHECK(count(builder.diagnostics, warning) == 1);
    }
    SUBCASE("a hair over it") {
        CHECK(stand(1e-5, table) == "");
        CHECK(all(builder.diagnostics) == "");
    }
    SUBCASE("a hair in it") {
        CHECK(stand(-1e-5, table) == "table in glass");
        CHECK(all(builder.diagnostics) == "");
    }
    SUBCASE("next to it") {
        stand(0, {{2, 0, 0}, {1, 0, 0}, {0, 0, 1}});
        CHECK(all(builder.diagnostics) == "");
    }
    SUBCASE("a label of thin glass") {
        builder.rectangle("label", {{0.2, 0.2, 1}, {0.5, 0, 0}, {0, 0.5, 0}}, kThin);
        stand(1, table);
        CHECK(count(builder.diagnostics, "faces of glass and label lie on each other") == 0);  // the glass is elsewhere
        builder.scene.objects[2].instances[0].translate = {};
        builder.volumes();
        CHECK(count(builder.diagnostics, "faces of glass and label lie on each other") == 1);
    }
    SUBCASE("an opaque ball in a ball of glass") {
        builder.sphere("core", {0, 0, 0}, 1, kWhite);
        builder.sphere("shell", {0, 0, 0}, 1);
        builder.volumes();
        CHECK(count(builder.diagnostics, "faces of shell and core lie on each other") == 1);
    }
}

TEST_CASE("priorities win over sizes, and go before them in the order") {
    Builder builder;
    builder.sphere("big", {0, 0, 0}, 2).priority = 2;
    builder.sphere("small", {0.5, 0, 0}, 1);
    builder.sphere("middle", {0, 1, 0}, 1.9);
    builder.rectangle("floor", {{-5, -5, -5}, {9, 0, 0}, {0, 0, 9}}, kWhite);
    const Volumes volumes = builder.volumes();
    CHECK(builder.order(volumes) == "middle small big floor ");
    CHECK(contains(builder.displacements(volumes), "big over small: its priority is higher (2 over 0); "));
    CHECK(contains(builder.displacements(volumes), "big over middle: its priority is higher (2 over 0); "));
    CHECK(all(builder.diagnostics) == "");
    CHECK(volumes.capacity == 3);
}

TEST_CASE("a guess between volumes of like size is warned of") {
    Builder builder;
    builder.sphere("a", {0, 0, 0}, 1);
    builder.sphere("b", {1, 0, 0}, 0.95);
    builder.volumes();
    CHECK(
        all(builder.diagnostics) ==
        "s.json:2:1: warning: a and b overlap and are of like size: it is a guess that b displaces a; give one of them a higher "
        "\"priority\"\n");
    builder.scene.objects[0].priority = 1;
    builder.volumes();
    CHECK(all(builder.diagnostics) == "");
    builder.scene.objects[0].priority = 0;
    builder.scene.objects[1].sphere.radius = 0.9;  // 27 % less
    builder.volumes();
    CHECK(all(builder.diagnostics) == "");
}

TEST_CASE("many pairs of a kind are warned of a few times, with a count of the rest") {
    Builder builder;
    for (int i = 0; i < 13; ++i) builder.sphere("s" + std::to_string(i), {0.5 * i, 0, 0}, 0.4);
    builder.volumes();
    CHECK(count(builder.diagnostics, "it is a guess") == 8);
    CHECK(count(builder.diagnostics, "4 more pairs of volumes overlap and are of like size") == 1);
}

TEST_CASE("many things on glass are warned of a few times, with a count of the rest") {
    Builder builder;
    builder.mesh("plate", box({20, 1, 1}));
    for (int i = 0; i < 11; ++i) builder.mesh("cube", box(), at({1.5 * i, 1, 0}), kWhite);
    builder.volumes();
    CHECK(count(builder.diagnostics, "faces of plate and cube lie on each other") == 8);
    CHECK(count(builder.diagnostics, "3 more pairs of bodies have faces that lie on each other") == 1);
}

TEST_CASE("the boxes that are near each other are those that comparing each with each finds") {
    test::Random random(11);
    for (const double reach : {0.0, 0.05}) {
        std::vector<Aabb> boxes;
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 center(random.inCube(1)), half = 0.4f * glm::abs(glm::vec3(random.inCube(1)));
            boxes.push_back(i % 50 == 7 ? Aabb{} : Aabb{center - half, center + half});
        }
        const auto wanted = [](uint32_t i, uint32_t k) { return (i + k) % 3 != 0; };
        std::vector<IndexPair> expected;
        for (uint32_t i = 0; i < boxes.size(); ++i)
            for (uint32_t k = i + 1; k < boxes.size(); ++k)
                if (wanted(i, k) && areNear(boxes[i], boxes[k], reach)) expected.emplace_back(i, k);
        CHECK(expected.size() > 100);
        CHECK(nearPairs(boxes, reach, wanted) == expected);
    }
}

TEST_CASE("what is found of volumes does not depend on the number of threads") {
    Builder builder;
    test::Random random(5);
    for (int i = 0; i < 60; ++i) {
        const std::string number = std::to_string(i);
        const Transform placement = at(random.inCube(1.5), glm::dvec3(0.2 + 0.01 * (i % 7)), 180.0 * random.inCube(1));
        builder.mesh("mesh" + number, i % 2 ? box() : test::ball(2), placement, i % 5 ? kGlass : kWhite);
        builder.sphere("sphere" + number, random.inCube(1.5), 0.2, i % 3 ? kGlass : kWhite);
    }
    builder.mesh("fine", test::ball(5), at({}, glm::dvec3(0.8)));  // large enough for threads of its own
    builder.mesh("like", test::ball(5), at({}, glm::dvec3(0.8)));
    const auto found = [&](unsigned threads) {
        builder.diagnostics = {};
        builder.geometry = flatten(builder.scene, builder.diagnostics);
        const Volumes volumes = analyseVolumes(builder.scene, builder.geometry, builder.diagnostics, threads);
        return builder.displacements(volumes) + builder.order(volumes) + volumes.overlap + volumes.content + volumes.selfOverlap +
               std::to_string(volumes.capacity) + all(builder.diagnostics);
    };
    const std::string one = found(1);
    CHECK(contains(one, "lie on each other"));
    CHECK(contains(one, "it is a guess"));
    for (const unsigned threads : {2u, 5u, 0u}) CHECK(found(threads) == one);
}

TEST_CASE("thick glass: a cavity is no overlap, and what is in the cavity is not in the glass") {
    Builder builder;
    builder.mesh("bulb", both(test::ball(3), flipped(test::ball(3)), 0.8, {}));
    SUBCASE("empty") {
        const Volumes volumes = builder.volumes();
        CHECK(volumes.selfOverlap.empty());
        CHECK(all(builder.diagnostics) == "");
    }
    SUBCASE("gas in the cavity, apart from the wall") {
        builder.mesh("gas", test::ball(3), at({}, glm::dvec3(0.7)));
        builder.sphere("wire", {0, 0, 0}, 0.2, kWhite);
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes).empty());
        CHECK(volumes.content == "wire in gas");
    }
    SUBCASE("gas that reaches into the wall: neither is in the other") {
        builder.mesh("gas", test::ball(3), at({}, glm::dvec3(0.9)));
        const Volumes volumes = builder.volumes();
        CHECK(builder.displacements(volumes) == "bulb over gas: it is smaller (2 m^3 against 2.98 m^3); ");
        CHECK(volumes.overlap == "bulb overlaps gas");
    }
}

TEST_CASE("a volume that overlaps itself") {
    Builder builder;
    SUBCASE("a shell in a shell of the same orientation") {
        builder.mesh("m", both(test::ball(2), test::ball(2), 0.5, {}));
        CHECK(builder.volumes().selfOverlap == "m overlaps itself");
    }
    SUBCASE("shells that cross") {
        builder.mesh("m", both(test::ball(2), test::ball(2), 0.5, {0.9, 0.1, 0}));
        CHECK(builder.volumes().selfOverlap == "m overlaps itself");
    }
    SUBCASE("shells that cross from edge to edge") {
        builder.mesh("m", both(test::ball(0), test::ball(0), 1, {1, 0, 0}));
        CHECK(builder.volumes().selfOverlap == "m overlaps itself");
    }
    SUBCASE("the same twice") {
        builder.mesh("m", both(box(), box(), 1, {}));
        CHECK(builder.volumes().selfOverlap == "m overlaps itself");
    }
    SUBCASE("shells side by side") {
        builder.mesh("m", both(test::ball(2), test::ball(2), 1, {3, 0, 0}));
        CHECK(builder.volumes().selfOverlap.empty());
    }
    SUBCASE("shells with an edge in common") {
        builder.mesh("m", both(box(), box(), 1, {1, 1, 0.5}));
        CHECK(builder.volumes().selfOverlap.empty());
    }
    SUBCASE("a ball in a bubble in a ball") {
        const ClosedMesh hollow = both(test::ball(2), flipped(test::ball(2)), 0.8, {});
        builder.mesh("m", both(hollow, test::ball(2), 0.5, {}));
        CHECK(builder.volumes().selfOverlap.empty());
    }
    SUBCASE("large enough for threads") {
        builder.mesh("m", both(test::ball(6), test::ball(2), 0.01, {0.9999, 0, 0}));
        CHECK(builder.volumes().selfOverlap == "m overlaps itself");
    }
    SUBCASE("large and sound") {
        builder.mesh("m", test::ball(6));
        CHECK(builder.volumes().selfOverlap.empty());
    }
    SUBCASE("a piece that is inside out") {
        builder.mesh("m", both(test::ball(2), flipped(test::ball(2)), 0.5, {3, 0, 0}));
        CHECK(builder.volumes().selfOverlap == "m overlaps itself");
        CHECK(count(builder.diagnostics, "m is inside out in part") == 1);
    }
}

TEST_CASE("capacity follows from what overlaps what") {
    Builder builder;
    SUBCASE("many ice cubes that do not touch, in a drink in a solid glass") {
        builder.mesh("glass", box({10, 10, 10}));
        builder.mesh("drink", box({8, 8, 8}), at({1, 1, 1}));
        for (int i = 0; i < 27; ++i)
            builder.mesh("ice", box(), at(1.7 + 2.3 * glm::dvec3(i % 3, i / 3 % 3, i / 9), glm::dvec3(1), {3.0 * i, 20, 0}));
        CHECK(builder.volumes().capacity == 3);
    }
    SUBCASE("a chain needs two") {
        for (int i = 0; i < 10; ++i) builder.sphere("s", {1.5 * i, 0, 0}, 1 + 0.2 * (i % 2));
        CHECK(builder.volumes().capacity == 2);
    }
    SUBCASE("sixteen concentric spheres fit") {
        for (int i = 1; i <= 16; ++i) builder.sphere("s", {0, 0, 0}, i);
        CHECK(builder.volumes().capacity == 16);
        CHECK(all(builder.diagnostics) == "");
    }
    SUBCASE("eighteen do not") {
        for (int i = 1; i <= 18; ++i) builder.sphere("s", {0, 0, 0}, i);
        CHECK(builder.volumes().capacity == kMostNested);
        CHECK(all(builder.diagnostics) ==
              "s.json: warning: up to 18 volumes may lie over one another, and a ray keeps track of 16; the surfaces of more are "
              "passed "
              "over, and counted as volume_overflow\n");
    }
}

TEST_CASE("content: what is no volume and lies in one or crosses it") {
    Builder builder;
    builder.mesh("tank", box({2, 2, 2}));
    const glm::dvec3 along(0.5, 0, 0), up(0, 0.5, 0);
    SUBCASE("inside") {
        builder.mesh("fish", test::ball(1), at({1, 1, 1}, glm::dvec3(0.2)), kWhite);
        CHECK(builder.volumes().content == "fish in tank");
    }
    SUBCASE("thin glass inside") {
        builder.rectangle("pane", {{0.5, 0.5, 1}, along, up}, kThin);
        CHECK(builder.volumes().content == "pane in tank");
    }
    SUBCASE("crossing") {
        builder.rectangle("rod", {{1.7, 0.5, 1}, along, up}, kWhite);
        CHECK(builder.volumes().content == "rod in tank");
    }
    SUBCASE("a large thing through the whole volume") {
        builder.rectangle("floor", {{-50, 1, -50}, {0, 0, 100}, {100, 0, 0}}, kWhite);
        CHECK(builder.volumes().content == "floor in tank");
    }
    SUBCASE("an opaque sphere that pokes in") {
        builder.sphere("nose", {1, 1, 2.05}, 0.1, kWhite);
        CHECK(builder.volumes().content == "nose in tank");
    }
    SUBCASE("on its surface") {
        builder.rectangle("table", {{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}, kWhite);
        CHECK(builder.volumes().content == "table in tank");
    }
    SUBCASE("below it") {
        builder.rectangle("table", {{-50, -1e-5, -50}, {0, 0, 100}, {100, 0, 0}}, kWhite);
        CHECK(builder.volumes().content.empty());
    }
    SUBCASE("around it") {
        builder.mesh("room", flipped(test::ball(2)), at({}, glm::dvec3(9)), kWhite);
        CHECK(builder.volumes().content.empty());
    }
    SUBCASE("in its box only") {
        builder.scene.objects.clear();
        builder.mesh("ring", test::torus(48, 24));
        builder.mesh("finger", test::ball(3), at({}, {0.3, 2, 0.3}), kWhite);
        builder.sphere("pearl", {0, 0, 0}, 0.35, kWhite);
        CHECK(builder.volumes().content.empty());
    }
}

TEST_CASE("content: lights") {
    Builder builder;
    builder.mesh("jar", both(test::ball(3), flipped(test::ball(3)), 0.8, {}), at({10, 20, 30}));
    Light light;
    light.type = LightType::directional;
    light.position = {10.9, 20, 30};
    builder.scene.lights = {light};
    CHECK(builder.volumes().content.empty());
    light.type = LightType::point;
    SUBCASE("in the wall") {
        builder.scene.lights.push_back(light);
        CHECK(builder.volumes().content == "light 1 in jar");
    }
    SUBCASE("in the cavity") {
        light.position = {10.2, 20, 30};
        builder.scene.lights.push_back(light);
        CHECK(builder.volumes().content.empty());
    }
}

TEST_CASE("each instance is a volume, and so are the faces of each transmissive material of a mesh") {
    Builder builder;
    Object& object = builder.mesh("m.obj", both(box(), box(), 1, {0.2, 0.3, 0.4}));
    object.material = kNone;
    object.instances = {at({}), at({5, 0, 0})};
    builder.scene.materials[kGlass].name = "glass";
    builder.scene.materials.push_back(builder.scene.materials[kGlass]);
    builder.scene.materials[3].name = "water";
    builder.scene.meshes[0].materials = {kGlass, 3};
    for (size_t i = 0; i < 24; ++i) builder.scene.meshes[0].faces[i].material = i < 12 ? 0 : 1;
    const Volumes volumes = builder.volumes();
    CHECK(volumes.count == 4);
    CHECK(volumes.displacements.size() == 2);
    CHECK(volumes.overlap == "m.obj[0] (glass) overlaps m.obj[0] (water)");
    CHECK(volumes.selfOverlap.empty());
}

TEST_CASE("random boxes overlap exactly where an independent test says so") {
    int overlapping = 0;
    for (int i = 0; i < 300; ++i) {
        // On a coarse lattice, so that faces, edges and corners often meet exactly; axis-aligned, so that comparing numbers decides.
        const auto lattice = [&](int k, int size) {
            return static_cast<double>((i * 7919 + k * 104729 + i * i * k * 31) % size);
        };
        const glm::dvec3 position(lattice(1, 7) - 3, lattice(2, 7) - 3, lattice(3, 7) - 3);
        const glm::dvec3 size(lattice(4, 3) + 1, lattice(5, 3) + 1, lattice(6, 3) + 1);
        Builder builder;
        builder.mesh("a", box({2, 2, 2}));
        builder.mesh("b", box(size), at(position));
        const glm::dvec3 lo = glm::max(position, glm::dvec3(0)), hi = glm::min(position + size, glm::dvec3(2));
        const bool expected = lo.x < hi.x && lo.y < hi.y && lo.z < hi.z;
        CHECK_MESSAGE(builder.volumes().displacements.size() == (expected ? 1 : 0), "case ", i);
        overlapping += expected ? 1 : 0;
    }
    CHECK(overlapping > 50);
    CHECK(overlapping < 250);
}

TEST_CASE("random parallelepipeds overlap exactly where no plane separates them") {
    test::Random random(7);
    int overlapping = 0;
    for (int i = 0; i < 300; ++i) {
        Builder builder;
        for (const char* name : {"a", "b"}) {
            glm::dvec3 x = random.direction(), y = random.direction(), z = random.direction();
            if (glm::dot(glm::cross(x, y), z) < 0) std::swap(x, y);
            builder.mesh(name, sheared(x, y, z), at(random.inCube(0.8)));
        }
        const size_t pairs = builder.volumes().displacements.size();
        const bool expected = !isSeparated(builder.geometry);
        CHECK_MESSAGE(pairs == (expected ? 1 : 0), "case ", i);
        overlapping += expected ? 1 : 0;
    }
    CHECK(overlapping > 50);
    CHECK(overlapping < 250);
}

TEST_CASE("the whisky: ice displaces the whisky, glass and whisky are ordered") {
    if (!test::haveShared("scenes/seed/whisky.json")) return;
    Diagnostics diagnostics;
    const Scene scene = loadScene(test::sharedDir() / "scenes/seed/whisky.json", diagnostics);
    const Geometry geometry = flatten(scene, diagnostics);
    const Volumes volumes = analyseVolumes(scene, geometry, diagnostics);
    std::vector<std::string> pairs;
    for (const Displacement& pair : volumes.displacements)
        pairs.push_back(geometry.bodies[pair.above].name + " over " + geometry.bodies[pair.below].name);
    CHECK(pairs == std::vector<std::string>{"glass.obj over water.obj", "ice.obj over water.obj"});
    CHECK(volumes.count == 3);
    CHECK(volumes.content.empty());
    CHECK(volumes.overlap == "glass.obj overlaps water.obj");
    CHECK(volumes.selfOverlap == "ice.obj overlaps itself");  // its cubes are pushed into one another
}

TEST_CASE("the other seed scenes have sound volumes") {
    for (const std::string name : {"five", "gem", "duck", "whisky_phong", "whisky_airgap"}) {
        if (!test::haveShared("scenes/seed/" + name + ".json")) return;
        Diagnostics diagnostics;
        const Scene scene = loadScene(test::sharedDir() / "scenes/seed" / (name + ".json"), diagnostics);
        const Geometry geometry = flatten(scene, diagnostics);
        const Volumes volumes = analyseVolumes(scene, geometry, diagnostics);
        CHECK_MESSAGE(volumes.count > 0, name);
        CHECK_MESSAGE((name[0] == 'w') == !volumes.overlap.empty(), name);
    }
}
