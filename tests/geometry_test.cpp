#include "geometry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "support.hpp"

using namespace minirtc;

namespace {

/// A scene of one white mesh object.
Scene meshScene(const std::vector<glm::dvec3>& positions, const std::vector<std::array<uint32_t, 3>>& faces) {
    Scene scene;
    scene.path = "s.json";
    scene.materials.resize(1);
    Mesh mesh;
    mesh.path = "m.obj";
    mesh.positions = positions;
    for (const auto& f : faces) {
        Face face;
        for (int i = 0; i < 3; ++i) face.corners[i].position = f[i];
        face.line = 100 + static_cast<int>(mesh.faces.size());
        mesh.faces.push_back(face);
    }
    scene.meshes.push_back(mesh);
    Object object;
    object.name = "m.obj";
    object.location = {"s.json", 5, 3};
    object.mesh = 0;
    object.material = 0;
    scene.objects.push_back(object);
    return scene;
}

/// The cube [-1,1]^3, corner i at the signs of i's bits. Bit `quad` of `cuts` picks the diagonal of each side.
Scene cube(unsigned cuts) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 8; ++i) positions.push_back(glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    const std::array<uint32_t, 4> quads[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<std::array<uint32_t, 3>> faces;
    for (int i = 0; i < 6; ++i) {
        const auto& q = quads[i];
        if (cuts >> i & 1) {
            faces.push_back({q[0], q[1], q[2]});
            faces.push_back({q[0], q[2], q[3]});
        } else {
            faces.push_back({q[0], q[1], q[3]});
            faces.push_back({q[1], q[2], q[3]});
        }
    }
    return meshScene(positions, faces);
}

Geometry flat(const Scene& scene) {
    Diagnostics diagnostics;
    return flatten(scene, diagnostics);
}

glm::vec3 areaVector(const Primitive& t) {
    return glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
}

std::string error(const Scene& scene) {
    Diagnostics diagnostics;
    try {
        flatten(scene, diagnostics);
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

bool outward(const Geometry& geometry) {
    return std::all_of(geometry.primitives.begin(), geometry.primitives.end(),
                       [](const Primitive& t) { return glm::dot(areaVector(t), t.p[0] + t.p[1] + t.p[2]) > 0; });
}

const std::vector<std::array<uint32_t, 3>> kOneFace = {{0, 1, 2}};

}  // namespace

TEST_CASE("a transform scales then turns about X then Y then Z then moves") {
    const glm::dvec3 p(0.3, -1.2, 2.5), scale(2, -3, 0.5), rotate(20, -35, 110), translate(5, -7, 11);
    glm::dvec3 q = p * scale;
    const glm::dvec3 a = glm::radians(rotate);
    q = {q.x, q.y * std::cos(a.x) - q.z * std::sin(a.x), q.y * std::sin(a.x) + q.z * std::cos(a.x)};
    q = {q.x * std::cos(a.y) + q.z * std::sin(a.y), q.y, -q.x * std::sin(a.y) + q.z * std::cos(a.y)};
    q = {q.x * std::cos(a.z) - q.y * std::sin(a.z), q.x * std::sin(a.z) + q.y * std::cos(a.z), q.z};
    q += translate;

    Scene scene = meshScene({p, {9, 0, 0}, {0, 9, 0}}, kOneFace);
    scene.objects[0].instances[0] = {scale, rotate, translate};
    const Geometry geometry = flat(scene);
    REQUIRE(geometry.primitives.size() == 1);
    CHECK(glm::length(glm::dvec3(geometry.primitives[0].p[0]) + geometry.origin - q) < 1e-5);
}

TEST_CASE("quarter turns are exact") {
    Scene scene = meshScene({{1, 2, 3}, {9, 2, 3}, {1, 9, 3}}, kOneFace);
    scene.objects[0].instances[0].rotate = {90, -180, 270};
    const Geometry geometry = flat(scene);
    // X: (1,-3,2); Y by -180: (-1,-3,-2); Z by 270: (-3,1,-2).
    CHECK(glm::dvec3(geometry.primitives[0].p[0]) + geometry.origin == glm::dvec3(-3, 1, -2));
}

TEST_CASE("the origin is the centre of the bounds and keeps far scenes precise") {
    const glm::dvec3 far(1e8, -2e8, 3e8);
    Scene scene = meshScene({far, far + glm::dvec3(0.001, 0, 0), far + glm::dvec3(0, 0.001, 0.002)}, kOneFace);
    const Geometry geometry = flat(scene);
    CHECK(glm::length(geometry.origin - (far + glm::dvec3(0.0005, 0.0005, 0.001))) < 1e-7);
    CHECK(geometry.boundsMax.x == doctest::Approx(0.0005).epsilon(1e-4));
    CHECK(geometry.boundsMin.x == doctest::Approx(-0.0005).epsilon(1e-4));
    const Primitive& t = geometry.primitives[0];
    CHECK(glm::length(t.p[1] - t.p[0]) == doctest::Approx(0.001).epsilon(1e-4));
}

TEST_CASE("a mirroring scale keeps faces and normals outward") {
    for (const glm::dvec3& scale : {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 1), glm::dvec3(2, -3, 4), glm::dvec3(-1, -2, -3)}) {
        for (const bool smooth : {false, true}) {
            Scene scene = cube(0);
            scene.objects[0].instances[0].scale = scale;
            scene.objects[0].instances[0].rotate = {10, 20, 30};
            scene.objects[0].smooth = smooth;
            const Geometry geometry = flat(scene);
            CHECK(geometry.primitives.size() == 12);
            CHECK(outward(geometry));
            CHECK(geometry.anySmooth == smooth);
            for (const Primitive& t : geometry.primitives)
                for (int i = 0; smooth && i < 3; ++i) CHECK(glm::dot(geometry.corners[t.corners].normals[i], t.p[i]) > 0);
        }
    }
}

TEST_CASE("file normals turn by the inverse transpose") {
    // A plane through (1,0,0), (0,1,0) and along z: its normal (1,1,0) becomes (1/2,1,0) when x is doubled.
    for (const double mirror : {1.0, -1.0}) {
        Scene scene = meshScene({{1, 0, 0}, {0, 1, 0}, {0, 1, 1}}, kOneFace);
        scene.meshes[0].normals = {glm::normalize(glm::vec3(1, 1, 0.5f))};
        for (Corner& corner : scene.meshes[0].faces[0].corners) corner.normal = 0;
        scene.objects[0].instances[0].scale = {2 * mirror, 1, 1};
        const Geometry geometry = flat(scene);
        CHECK(geometry.anySmooth);
        const glm::vec3 expected = glm::normalize(glm::vec3(0.5 * mirror, 1, 0.5));
        CHECK(glm::length(geometry.corners[0].normals[0] - expected) < 1e-6f);
        CHECK(glm::dot(areaVector(geometry.primitives[0]), expected) > 0);
    }
}

TEST_CASE("a cube corner averages to its exact diagonal whatever the cuts") {
    for (unsigned cuts = 0; cuts < 64; ++cuts) {
        Scene scene = cube(cuts);
        scene.objects[0].smooth = true;
        const Geometry geometry = flat(scene);
        for (const Primitive& t : geometry.primitives)
            for (int i = 0; i < 3; ++i)
                CHECK(glm::length(geometry.corners[t.corners].normals[i] - glm::normalize(t.p[i])) < 1e-6f);
    }
}

TEST_CASE("normals are weighted by the angle at the vertex") {
    // At the origin: 90 degrees of a face towards +z and 45 degrees of one towards +x.
    Scene scene = meshScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 5, 0}, {0, 0, -5}, {0, 3, -3}}, {{0, 1, 2}, {0, 5, 3}});
    scene.objects[0].smooth = true;
    const Geometry geometry = flat(scene);
    const glm::vec3 second = glm::normalize(areaVector(geometry.primitives[1]));
    CHECK(std::fabs(second.x) == doctest::Approx(1));
    const glm::vec3 expected = glm::normalize(glm::vec3(0, 0, 2) + second);
    CHECK(glm::length(geometry.corners[geometry.primitives[0].corners].normals[0] - expected) < 1e-6f);
}

TEST_CASE("vertices with the same place share a normal") {
    // Two faces of a roof that share their ridge by value only, once as -0.
    Scene scene = meshScene({{-1, 0, 0}, {0, 1, 0}, {0, 1, -1}, {1, 0, 0}, {0, 1, -1}, {-0.0, 1, -0.0}}, {{0, 1, 2}, {3, 4, 5}});
    scene.objects[0].smooth = true;
    const Geometry geometry = flat(scene);
    REQUIRE(geometry.corners.size() == 2);
    const glm::vec3 ridge = geometry.corners[0].normals[2];
    CHECK(glm::length(ridge - geometry.corners[1].normals[1]) < 1e-6f);
    CHECK(std::fabs(ridge.x) < 0.5f);
}

TEST_CASE("faces without area are dropped and leave the normals alone") {
    Scene scene = meshScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {1, 0, 0}},
                            {{0, 1, 2}, {1, 3, 2}, {0, 0, 1}, {1, 4, 2}, {0, 1, 2}});
    scene.objects[0].smooth = true;
    Diagnostics diagnostics;
    const Geometry geometry = flatten(scene, diagnostics);
    CHECK(geometry.primitives.size() == 2);
    CHECK(geometry.degenerateTriangles == 3);
    CHECK_FALSE(geometry.anySmooth);
    CHECK(geometry.corners.empty());
    REQUIRE(diagnostics.warnings.size() == 1);
    CHECK(diagnostics.warnings[0] == "s.json:5:3: warning: 3 of 5 triangles of m.obj have no area; they are left out");
}

TEST_CASE("nothing but faces without area is an error") {
    CHECK(error(meshScene({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, kOneFace)) ==
          "s.json: no triangle of the scene has an area; check the meshes and their scale");
    Scene empty;
    empty.path = "s.json";
    CHECK(error(empty) == "s.json: there is nothing to render; add an object with faces");
}

TEST_CASE("needles and opposed faces give unit normals") {
    Scene scene =
        meshScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-4, 1e-12, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}, {4, 3, 2}});
    scene.objects[0].smooth = true;
    const Geometry geometry = flat(scene);
    for (const CornerAttributes& corner : geometry.corners)
        for (const glm::vec3& n : corner.normals) CHECK(glm::length(n) == doctest::Approx(1));
}

TEST_CASE("normals on the back of their face are made consistent") {
    Scene scene = meshScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, kOneFace);
    const glm::vec3 tilted = glm::normalize(glm::vec3(0.1f, 0, 1));
    scene.meshes[0].normals = {-tilted, tilted, glm::vec3(0)};
    auto& corners = scene.meshes[0].faces[0].corners;
    for (Corner& corner : corners) corner.normal = 0;
    CHECK(glm::length(flat(scene).corners[0].normals[0] - tilted) < 1e-6f);  // all behind: turned
    corners[1].normal = corners[2].normal = 1;
    CHECK(flat(scene).corners[0].normals[0] == glm::vec3(0, 0, 1));  // one behind: replaced
    CHECK(glm::length(flat(scene).corners[0].normals[1] - tilted) < 1e-6f);
    corners[0].normal = 2;
    CHECK(flat(scene).corners[0].normals[0] == glm::vec3(0, 0, 1));  // of no length: replaced
    scene.objects[0].smooth = false;
    CHECK(flat(scene).corners.empty());
    CHECK_FALSE(flat(scene).anySmooth);
}

TEST_CASE("textured faces carry texture coordinates") {
    Scene scene = meshScene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, kOneFace);
    scene.materials.resize(2);
    scene.materials[0].diffuseTexture = 0;
    scene.materials[1].checker = true;
    scene.materials[1].checkerA = scene.materials[1].checkerB = 0;
    scene.meshes[0].uvs = {{0.25f, 0.75f}};
    scene.meshes[0].faces[0].corners[1].uv = 0;
    for (const uint32_t material : {0u, 1u}) {
        scene.objects[0].material = material;
        const Geometry geometry = flat(scene);
        REQUIRE(geometry.corners.size() == 1);
        CHECK(geometry.primitives[0].corners == 0);
        CHECK(geometry.corners[0].uvs[0] == glm::vec2(0));
        CHECK(geometry.corners[0].uvs[1] == glm::vec2(0.25f, 0.75f));
        CHECK(geometry.corners[0].normals[2] == glm::vec3(0, 0, 1));
        CHECK_FALSE(geometry.anySmooth);
    }
}

TEST_CASE("a rectangle becomes two triangles that face along u cross v") {
    Scene scene;
    scene.materials.resize(1);
    Object object;
    object.shape = ShapeType::rectangle;
    object.material = 0;
    object.rectangle = {{-10, -4, -5}, {20, 0, 0}, {0, 0, -25}};
    scene.objects.push_back(object);
    const Geometry geometry = flat(scene);
    REQUIRE(geometry.primitives.size() == 2);
    CHECK(geometry.origin == glm::dvec3(0, -4, -17.5));
    CHECK(areaVector(geometry.primitives[0]) == glm::vec3(0, 500, 0));
    CHECK(areaVector(geometry.primitives[1]) == glm::vec3(0, 500, 0));
    CHECK(geometry.boundsMin == glm::vec3(-10, 0, -12.5));
    CHECK(geometry.boundsMax == glm::vec3(10, 0, 12.5));
    CHECK(geometry.primitives[0].corners == kNone);
}

TEST_CASE("a sphere keeps its centre and radius") {
    Scene scene;
    scene.materials.resize(1);
    Object object;
    object.name = "sphere 1";
    object.shape = ShapeType::sphere;
    object.material = 0;
    object.sphere = {{100, 0, 0}, 2};
    scene.objects.push_back(object);
    const Geometry geometry = flat(scene);
    REQUIRE(geometry.primitives.size() == 1);
    CHECK(geometry.primitives[0].isSphere);
    CHECK(geometry.primitives[0].p[0] == glm::vec3(0));
    CHECK(geometry.primitives[0].p[1].x == 2);
    CHECK(geometry.origin == glm::dvec3(100, 0, 0));
    CHECK(geometry.boundsMax == glm::vec3(2));
}

TEST_CASE("each instance is a copy with a name of its own") {
    Scene scene = cube(0);
    scene.objects[0].instances.resize(3);
    scene.objects[0].instances[2].translate = {10, 0, 0};
    const Geometry geometry = flat(scene);
    CHECK(geometry.primitives.size() == 36);
    REQUIRE(geometry.bodies.size() == 3);
    for (uint32_t i = 0; i < 3; ++i) CHECK(geometry.bodies[i].name == "m.obj[" + std::to_string(i) + "]");
    CHECK(geometry.primitives[35].body == 2);
    CHECK(geometry.origin == glm::dvec3(5, 0, 0));
}

TEST_CASE("coordinates that single precision cannot hold are refused with the face") {
    Scene scene = cube(0);
    scene.objects[0].instances[0].scale = glm::dvec3(1e38);
    CHECK(error(scene) ==
          "m.obj:100: a coordinate of m.obj (object in line 5 of the scene) is over 1e18 in world space; single precision cannot "
          "hold it; scale it down");
    scene.objects[0].instances[0].scale = glm::dvec3(1e300, 1e300, 1e300);
    scene.objects[0].instances[0].rotate = {0, 0, 45};
    CHECK(error(scene).find("m.obj:100: ") == 0);
    scene.objects[0].instances[0].scale = glm::dvec3(1e17);
    CHECK(flat(scene).primitives.size() == 12);
}

TEST_CASE("features lost in rounding give one warning an object") {
    const auto warnings = [](double size) {
        Scene scene =
            meshScene({{-1000, 0, 0}, {-1000 + size, 0, 0}, {-1000, size, 0}, {1000, 0, 0}, {1000 + size, 0, 0}, {1000, size, 0}},
                      {{0, 1, 2}, {3, 4, 5}});
        Diagnostics diagnostics;
        flatten(scene, diagnostics);
        return diagnostics.warnings;
    };
    CHECK(warnings(0.01).empty());
    REQUIRE(warnings(0.001).size() == 1);
    CHECK(warnings(0.001)[0] ==
          "s.json:5:3: warning: m.obj has features under 64 float steps at their distance from the scene's centre; move the "
          "scene's parts "
          "closer together or make the features larger");
}

TEST_CASE("denormal coordinates become zero") {
    const Geometry geometry = flat(meshScene({{-1, -1, 1e-42}, {1, -1, -1e-42}, {0, 1, 0}}, kOneFace));
    for (const glm::vec3& p : geometry.primitives[0].p) CHECK(p.z == 0);
}

TEST_CASE("a million triangles flatten in seconds") {
    const uint32_t n = 720;
    std::vector<glm::dvec3> positions;
    std::vector<std::array<uint32_t, 3>> faces;
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j <= n; ++j) positions.push_back({i * 0.01, std::sin(i * 0.05) * std::cos(j * 0.04), j * 0.01});
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j) {
            const uint32_t a = i * (n + 1) + j;
            faces.push_back({a, a + 1, a + n + 2});
            faces.push_back({a, a + n + 2, a + n + 1});
        }
    Scene scene = meshScene(positions, faces);
    scene.objects[0].smooth = true;
    const auto start = std::chrono::steady_clock::now();
    CHECK(flat(scene).primitives.size() == 2 * n * n);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(30));
}
