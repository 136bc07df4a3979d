// A glass teapot with tea that others modelled in split interfaces, as closed volumes that lap over each other.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <tuple>

#include "scene_text.hpp"
#include "split_oracle.hpp"

using glm::dvec3;
using namespace test;

namespace {

struct PlyMesh {
    std::vector<dvec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    dvec3 at(size_t triangle, int corner) const { return points[triangles[triangle][static_cast<size_t>(corner)]]; }
};

/// Binary little endian, float properties with x y z first, triangles with 8-bit counts and 32-bit indices: what these files are.
PlyMesh readPly(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const size_t end = bytes.find("end_header\n") + 11;
    std::istringstream header(bytes.substr(0, end));
    size_t vertices = 0, faces = 0, floats = 0;
    for (std::string line; std::getline(header, line);) {
        if (line.rfind("element vertex ", 0) == 0) vertices = std::stoul(line.substr(15));
        if (line.rfind("element face ", 0) == 0) faces = std::stoul(line.substr(13));
        floats += line.rfind("property float ", 0) == 0 ? 1 : 0;
    }
    REQUIRE(bytes.size() == end + vertices * floats * 4 + faces * 13);
    PlyMesh mesh;
    for (size_t i = 0; i < vertices; ++i) {
        float p[3];
        std::memcpy(p, &bytes[end + i * floats * 4], sizeof p);
        mesh.points.emplace_back(double(p[0]), double(p[1]), double(p[2]));
    }
    for (size_t i = 0; i < faces; ++i) {
        std::array<uint32_t, 3> triangle;
        std::memcpy(triangle.data(), &bytes[end + vertices * floats * 4 + i * 13 + 1], sizeof triangle);
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

using Key = std::tuple<double, double, double>;
Key keyOf(const dvec3& p) {
    return {p.x, p.y, p.z};
}

/// Per position, the normal of the wall, weighted by area.
std::map<Key, dvec3> normalsOf(const PlyMesh& mesh) {
    std::map<Key, dvec3> normals;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const dvec3 n = glm::cross(mesh.at(i, 1) - mesh.at(i, 0), mesh.at(i, 2) - mesh.at(i, 0));
        for (int k = 0; k < 3; ++k) normals[keyOf(mesh.at(i, k))] += n;
    }
    return normals;
}

void addObj(std::string& obj, int& next, const PlyMesh& mesh, bool reversed, const std::map<Key, dvec3>* normals, double lap) {
    for (const dvec3& p : mesh.points) {
        dvec3 q = p;
        if (normals && normals->count(keyOf(p))) q -= lap * glm::normalize(normals->at(keyOf(p)));
        obj += "v " + json(q.x) + " " + json(q.y) + " " + json(q.z) + "\n";
    }
    for (const auto& t : mesh.triangles) {
        const auto number = [&](size_t k) { return std::to_string(next + static_cast<int>(t[k])); };
        obj += "f " + number(0) + " " + number(reversed ? 2 : 1) + " " + number(reversed ? 1 : 2) + "\n";
    }
    next += static_cast<int>(mesh.points.size());
}

void addFaces(std::vector<SplitFace>& faces, const PlyMesh& mesh, int front, int back) {
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        faces.push_back({mesh.at(i, 0), mesh.at(i, 1), mesh.at(i, 2), front, back});
}

/// A lit plane under the pot, with nothing between it and its light.
dvec3 table(const dvec3& p, const dvec3& d) {
    if (!(d.y < 0)) return dvec3(0.25);
    const dvec3 q = p + (-8 - p.y) / d.y * d;
    if (std::abs(q.x) > 60 || std::abs(q.z) > 60) return dvec3(0.25);
    const double d2 = 36 + q.x * q.x + q.z * q.z;
    return dvec3(0.5 * 60 * 6 / std::sqrt(d2) / d2);
}

}  // namespace

TEST_CASE("the teapot of nested-teapot-full renders as its split interfaces do") {
    if (!haveShared("scenes/real/scenes/nested-teapot-full")) return;
    GpuContext gpu;
    if (!gpu) return;
    const std::filesystem::path folder = sharedDir() / "scenes/real/scenes/nested-teapot-full/models";
    const PlyMesh wet = readPly(folder / "Mesh000.ply");    // glass to tea, its front in the tea
    const PlyMesh dry = readPly(folder / "Mesh001.ply");    // glass to air
    const PlyMesh level = readPly(folder / "Mesh002.ply");  // tea to air
    const PlyMesh lid = readPly(folder / "Mesh003.ply");
    const TemporaryDir dir;
    std::map<Key, dvec3> normals = normalsOf(wet);
    for (const dvec3& p : level.points) normals.at(keyOf(p)).y = 0;  // the tea stays level
    constexpr double kLap = 0.02;
    std::string pot, tea, cover;
    int potNext = 1, teaNext = 1, coverNext = 1;
    addObj(pot, potNext, dry, false, nullptr, 0);
    addObj(pot, potNext, wet, false, nullptr, 0);
    addObj(tea, teaNext, wet, true, &normals, kLap);
    addObj(tea, teaNext, level, false, &normals, kLap);
    addObj(cover, coverNext, lid, false, nullptr, 0);
    dir.write("pot.obj", pot);
    dir.write("tea.obj", tea);
    dir.write("lid.obj", cover);

    // The camera of scene.pbrt, whose matrix is mirrored; the tea's absorption: sigma_a times its scale.
    const View view{{23.17, 15.71, -0.17}, {-1.26, 2.03, -0.03}, 20.114292, 64, {0, 1, 0}, 16};
    const dvec3 sigma = 4.0 * dvec3(0.10404, 0.23958, 0.29325);
    const Picture picture = renderScene(
        gpu, dir,
        "{" + view.text() + R"(,"background":{"color":[0.25,0.25,0.25]},"lights":[)" +
            pointLight({0, -2, 0}, {60, 60, 60}, "inverse-square") + R"(],"materials":{"glass":)" + glass(1.5) +
            R"(,"tea":{"model":"pbr","roughness":0,"transmission":1,"ior":1.33,"attenuationColor":)" + json(glm::exp(-sigma)) +
            R"(},"table":{"model":"phong","diffuse":0.5}},"objects":[)" +
            R"({"mesh":"pot.obj","material":"glass","smooth":false},{"mesh":"tea.obj","material":"tea","smooth":false},)" +
            R"({"mesh":"lid.obj","material":"glass","smooth":false},)" +
            rectangle({-60, -8, -60}, {0, 0, 120}, {120, 0, 0}, "table") + "]}");

    std::vector<SplitFace> faces;
    addFaces(faces, dry, 0, 1);
    addFaces(faces, wet, 2, 1);
    addFaces(faces, level, 0, 2);
    addFaces(faces, lid, 0, 1);
    SplitScene split(faces, {{1, dvec3(0)}, {1.5, dvec3(0)}, {1.33, sigma}}, table);
    size_t differ = 0, glassy = 0;
    double sum = 0;
    for (uint32_t y = 0; y < view.size; ++y)
        for (uint32_t x = 0; x < view.size; ++x) {
            const dvec3 d = view.direction(x, y), expected = split.radiance(view.position, d, static_cast<int>(view.maxDepth));
            const double difference = glm::length(dvec3(picture.at(x, y)) - expected);
            sum += difference;
            glassy += glm::length(expected - table(view.position, d)) > 1e-6 ? 1 : 0;
            differ += difference > 0.02 * glm::length(expected) ? 1 : 0;
        }
    MESSAGE(glassy, " pixels show the pot, ", differ, " differ by over 2 %, mean difference ", sum / (view.size * view.size),
            ", ", split.misfits(), " misfits of the split faces");
    CHECK(glassy > 300);
    CHECK(differ * 50 < glassy);
}
