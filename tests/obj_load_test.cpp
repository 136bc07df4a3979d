#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>
#include <set>

#include "geometry.hpp"
#include "scene.hpp"
#include "support.hpp"
#include "triangulate.hpp"

using namespace minirtc;

namespace {

class Loader {
public:
    Mesh load(const std::string& obj) {
        scene = {};
        scene.render.integrator = integrator;
        return loadObj(dir.write("m.obj", obj), true, scene, diagnostics);
    }

    /// The error without the folder's name, or "".
    std::string error(const std::string& obj) {
        try {
            load(obj);
        } catch (const Error& error) {
            return strip(error.what());
        }
        return "";
    }

    std::string strip(std::string message) const {
        const std::string prefix = dir.path().string() + "/";
        for (size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
        return message;
    }

    /// The material of a one-face mesh with the .mtl text `mtl` after its newmtl line.
    Material material(const std::string& mtl) {
        dir.write("m.mtl", "newmtl a\n" + mtl);
        const Mesh mesh = load("mtllib m.mtl\nusemtl a\n" + kTriangle);
        REQUIRE(mesh.materials.size() == 1);
        return scene.materials.at(mesh.materials[0]);
    }

    test::TemporaryDir dir;
    Scene scene;
    Diagnostics diagnostics;
    Integrator integrator = Integrator::whitted;
    const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
};

glm::dvec3 areaVector(const std::vector<glm::dvec3>& polygon) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < polygon.size(); ++i) sum += glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return sum * 0.5;
}

/// For a flat simple polygon: as many triangles as it must have, all wound like it, areas that add up to its own: no overlap.
void checkTriangulation(const std::vector<glm::dvec3>& polygon, double tolerance = 1e-12) {
    std::vector<TriangleIndices> triangles;
    REQUIRE(triangulate(polygon, triangles));
    CHECK(triangles.size() == polygon.size() - 2);
    const glm::dvec3 whole = areaVector(polygon);
    double sum = 0;
    std::set<uint32_t> used;
    for (const TriangleIndices& t : triangles) {
        const glm::dvec3 area = areaVector({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
        CHECK(glm::dot(area, whole) >= 0);
        sum += glm::length(area);
        used.insert(t.begin(), t.end());
    }
    CHECK(std::fabs(sum - glm::length(whole)) <= tolerance * glm::length(whole));
    CHECK(used.size() == polygon.size());
}

std::vector<glm::dvec3> rotated(std::vector<glm::dvec3> polygon, size_t by) {
    std::rotate(polygon.begin(), polygon.begin() + static_cast<long>(by), polygon.end());
    return polygon;
}

}  // namespace

TEST_CASE("what is wrong in an obj file is named with its line") {
    const std::vector<std::pair<std::string, std::string>> table = {
        {"", "m.obj: the mesh has no faces; an OBJ file needs lines such as 'f 1 2 3'"},
        {"just some prose\nin two lines\n", "m.obj: the mesh has no faces; an OBJ file needs lines such as 'f 1 2 3'"},
        {"v 0 0 0\nv 1 nan 0\n", "m.obj:2: 'nan' is not a finite number; repair the line"},
        {"v 0 0 0\nv 1 -inf 0\n", "m.obj:2: '-inf' is not a finite number; repair the line"},
        {"v 0 0 1e999\n", "m.obj:1: '1e999' is not a finite number; repair the line"},
        {"\n\nv 0 0\n", "m.obj:3: the line ends before its z; give three numbers"},
        {"v 0 0 0 # fine\nv 0,0 0 0\n", "m.obj:2: '0,0' is not a finite number; repair the line"},
        {"v 1 2 3 4 5 6 7 8\n", "m.obj:1: too many numbers after v; a line break may be missing"},
        {"vt x\n", "m.obj:1: 'x' is not a finite number; repair the line"},
        {"vt 1e39 0\n", "m.obj:1: a texture coordinate is too large; repair the line"},
        {"vn 0 1\n", "m.obj:1: the line ends before its z; give three numbers"},
        {"v 0 0 0\nf 1 1\n", "m.obj:2: the face has 2 corners; a face needs at least 3"},
        {"v 0 0 0\nf 1 0 1\n",
         "m.obj:2: the v index 0 is out of range; indices count from 1, or from -1 backwards; 1 v lines stand above"},
        {"v 0 0 0\nf 1 -2 1\n",
         "m.obj:2: the v index -2 is out of range; indices count from 1, or from -1 backwards; 1 v lines stand above"},
        {"v 0 0 0\nf 1 99999999999999999999 1\n",
         "m.obj:2: the v index 99999999999999999999 is out of range; indices count from 1, or from -1 backwards; 1 v lines stand "
         "above"},
        {"v 0 0 0\n\nf 1 2 1\n", "m.obj:3: the v index 2 is out of range; the file has 1 v lines"},
        {"v 0 0 0\nf 1/1 1/1 1/1\n", "m.obj:2: the vt index 1 is out of range; the file has 0 vt lines"},
        {"v 0 0 0\nf 1//1 1//1 1//1\n", "m.obj:2: the vn index 1 is out of range; the file has 0 vn lines"},
        {"v 0 0 0\nf 1 1.5 1\n", "m.obj:2: '1.5' is not an index; write whole numbers, such as f 1 2 3"},
        {"v 0 0 0\nf 1/1/1/1 1 1\n", "m.obj:2: '1/1/1/1' is no corner of a face; write v, v/vt, v//vn or v/vt/vn"},
        {"v 0 0 0\nf 1 +-1 1\n", "m.obj:2: '+-1' is not an index; write whole numbers, such as f 1 2 3"},
        {"v 0 0 0\nvt 0 0\nf 1/0 1 1\n",
         "m.obj:3: the vt index 0 is out of range; indices count from 1, or from -1 backwards; 1 vt lines stand above"},
        {"v 0 0 0\nf /1 1 1\n", "m.obj:2: '/1' is no corner of a face; write v, v/vt, v//vn or v/vt/vn"},
        {std::string("v 0 0 0\nv \0\x01\x02 0\n", 16),
         "m.obj:2: the file is not text (it holds the byte 0); check that this is the file you meant"},
        {std::string("\xff\xfev\0", 4), "m.obj: the file is UTF-16; save it as UTF-8 or ASCII"},
    };
    Loader loader;
    for (const auto& [obj, message] : table) {
        CAPTURE(obj);
        CHECK(loader.error(obj) == message);
    }
    CHECK_THROWS_WITH_AS(loadObj("none.obj", true, loader.scene, loader.diagnostics),
                         "none.obj: the file cannot be opened; check that it exists and may be read", Error);
    CHECK_THROWS_WITH_AS(loadObj("/", true, loader.scene, loader.diagnostics), "/: this is a folder; name a file", Error);
}

TEST_CASE("the odd forms that obj files come in are read") {
    Loader loader;
    const std::string plain = loader.kTriangle;
    std::string crlf, cr;
    for (const char c : plain) crlf += c == '\n' ? "\r\n" : std::string(1, c), cr += c == '\n' ? '\r' : c;
    for (const std::string& text :
         {plain, crlf, cr, "\xef\xbb\xbf" + plain, plain.substr(0, plain.size() - 1), "# c\n\n \t\n" + plain,
          std::string("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 1 1 1\np 1\nl 1 2\ncstype bezier\nf 1 2 3\n"),
          std::string("v 0 \\\n 0 0\nv +1. .0 0e0\nv 0 1 0\nf 1 2 \\\n  3 # end"),
          std::string("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"),
          std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/\n"), "   " + plain}) {
        CAPTURE(text);
        const Mesh mesh = loader.load(text);
        REQUIRE(mesh.faces.size() == 1);
        const auto& corners = mesh.faces[0].corners;
        CHECK(mesh.positions[corners[0].position] == glm::dvec3(0, 0, 0));
        CHECK(mesh.positions[corners[1].position] == glm::dvec3(1, 0, 0));
        CHECK(mesh.positions[corners[2].position] == glm::dvec3(0, 1, 0));
    }
}

TEST_CASE("faces keep their line and texture rows start at the top") {
    Loader loader;
    const Mesh mesh = loader.load("v 0 0 0\nv 1 0 0\nv 0 1 0 \\\n\nvt 0.25 1\nvn 0 0 9\nf 1/1/1 2/1/1 3/1/1\nf 3/1 2 1\n");
    REQUIRE(mesh.faces.size() == 2);
    CHECK(mesh.faces[0].line == 7);
    CHECK(mesh.faces[1].line == 8);
    CHECK(mesh.uvs[0] == glm::vec2(0.25f, 0));
    CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));
    CHECK(mesh.faces[1].corners[0].uv == 0);
    CHECK(mesh.faces[1].corners[1].uv == kNone);
    CHECK(mesh.faces[1].corners[1].normal == kNone);
}

TEST_CASE("corners keep what they name and no more, numbers their digits") {
    Loader loader;
    const Mesh mesh = loader.load(
        "v 0e999 -0e-9999999999 1e-400\nv +.5e+1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0\nvn 0 0 1\nf 1// 2/ 3/1/ # end\nf 1/-1 2//+1 "
        "3//\n");
    CHECK(mesh.positions[0] == glm::dvec3(0));
    CHECK(mesh.positions[1] == glm::dvec3(5, 1, 0));
    REQUIRE(mesh.faces.size() == 2);
    const std::vector<Corner> expected = {{0, kNone, kNone}, {1, kNone, kNone}, {2, kNone, 0},
                                          {0, kNone, 0},     {1, 0, kNone},     {2, kNone, kNone}};
    for (size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        const Corner& corner = mesh.faces[i / 3].corners[i % 3];
        CHECK(corner.position == expected[i].position);
        CHECK(corner.normal == expected[i].normal);
        CHECK(corner.uv == expected[i].uv);
    }
}

TEST_CASE("numbers are read to 14 digits and more") {
    std::mt19937 random(1);
    const auto digits = [&](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += static_cast<char>('0' + random() % 10);
        return text;
    };
    std::string obj;
    std::vector<double> expected;
    for (int i = 0; i < 3000; ++i) {
        std::string number = (random() % 2 ? "-" : "") + digits(1 + random() % 18) + "." + digits(random() % 20);
        if (random() % 2) number += "e" + std::to_string(static_cast<int>(random() % 560) - 280);
        expected.push_back(std::strtod(number.c_str(), nullptr));
        obj += (i % 3 ? " " : "\nv ") + number;
    }
    Loader loader;
    const Mesh mesh = loader.load(obj + "\nf 1 2 3\n");
    REQUIRE(mesh.positions.size() == 1000);
    double worst = 0;
    for (int i = 0; i < 3000; ++i)
        if (expected[i] != 0) worst = std::max(worst, std::fabs(mesh.positions[i / 3][i % 3] / expected[i] - 1));
    CHECK(worst < 1e-14);
}

TEST_CASE("every prefix of an obj file loads or is refused") {
    Loader loader;
    loader.dir.write("m.mtl", "newmtl a\nKd 1 0 0\n");
    const std::string text =
        "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1.5e0 0 0 1\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -1//-1 "
        "-2//-1 -3//-1\n";
    size_t loaded = 0;
    for (size_t length = 0; length <= text.size(); ++length) {
        CAPTURE(length);
        const std::string error = loader.error(text.substr(0, length));
        if (error.empty())
            ++loaded;
        else
            CHECK(error.find("m.obj") == 0);
    }
    CHECK(loaded > 0);
}

TEST_CASE("concave polygons become triangles that tile them") {
    const std::vector<glm::dvec3> arrow = {{0, 0, 0}, {2, -1, 0}, {0, 3, 0}, {-2, -1, 0}};
    const std::vector<glm::dvec3> comb = {{0, 0, 1}, {9, 0, 1}, {9, 3, 1}, {8, 3, 1}, {8, 1, 1}, {6, 1, 1},
                                          {6, 3, 1}, {5, 3, 1}, {5, 1, 1}, {3, 1, 1}, {3, 3, 1}, {0, 3, 1}};
    const std::vector<glm::dvec3> collinear = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    // A square with a square hole, joined by a bridge that is walked twice.
    const std::vector<glm::dvec3> keyhole = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                             {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    std::vector<glm::dvec3> spiral;
    for (int i = 0; i <= 60; ++i) spiral.push_back({(1 + i * 0.2) * std::cos(i * 0.3), 0, (1 + i * 0.2) * std::sin(i * 0.3)});
    for (int i = 60; i >= 0; --i) spiral.push_back({(1.5 + i * 0.2) * std::cos(i * 0.3), 0, (1.5 + i * 0.2) * std::sin(i * 0.3)});
    for (const auto& polygon : {arrow, comb, collinear, keyhole, spiral}) {
        for (size_t start = 0; start < polygon.size(); ++start) {
            CAPTURE(start);
            CAPTURE(polygon.size());
            checkTriangulation(rotated(polygon, start));
            auto reversed = rotated(polygon, start);
            std::reverse(reversed.begin(), reversed.end());
            checkTriangulation(reversed);
        }
    }
}

TEST_CASE("a tilted concave polygon far from the origin is tiled too") {
    std::vector<glm::dvec3> star;
    for (int i = 0; i < 20; ++i) {
        const double r = i % 2 ? 1 : 3, a = i * glm::pi<double>() / 10;
        star.push_back(glm::dvec3(8000, -6000, 3000) + glm::dvec3(0.8, 0.6, 0) * (r * std::cos(a)) +
                       glm::dvec3(0, 0, 1) * (r * std::sin(a)));
    }
    for (size_t start = 0; start < star.size(); ++start) checkTriangulation(rotated(star, start), 1e-9);
}

TEST_CASE("a quad is cut along its shorter diagonal") {
    std::vector<TriangleIndices> triangles;
    REQUIRE(triangulate({{0, 0, 0}, {2, -1, 0}, {4, 0, 0}, {2, 1, 0}}, triangles));
    CHECK(triangles == std::vector<TriangleIndices>{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("polygons that cross themselves or have no area end as triangles") {
    for (const std::vector<glm::dvec3>& polygon :
         {std::vector<glm::dvec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 5, 0}, {1, -5, 0}},
          std::vector<glm::dvec3>(7, glm::dvec3(1)),
          std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}}) {
        std::vector<TriangleIndices> triangles;
        CHECK(triangulate(polygon, triangles));
        CHECK(triangles.size() == polygon.size() - 2);
    }
}

TEST_CASE("a face of a thousand corners keeps them all and a huge concave one is refused") {
    std::string obj, zigzag;
    for (int i = 0; i < 1000; ++i)
        obj += "v " + std::to_string(std::cos(i * 0.0062831853)) + " " + std::to_string(std::sin(i * 0.0062831853)) + " 0\n";
    std::string face = "f";
    for (int i = 1; i <= 1000; ++i) face += " " + std::to_string(i);
    Loader loader;
    CHECK(loader.load(obj + face + "\n").faces.size() == 998);

    std::string large = "f";
    for (int i = 0; i < 5000; ++i) {
        zigzag += "v " + std::to_string(i) + " " + std::to_string(i % 2) + " 0\n";
        large += " " + std::to_string(i + 1);
    }
    CHECK(loader.error(zigzag + large + "\n") ==
          "m.obj:5001: the face is concave and has 5000 corners; split it into smaller faces");
}

TEST_CASE("mtl materials follow the table of the scene format") {
    Loader loader;
    const glm::vec3 kd(0.5f, 0.25f, 0.125f), ks(0.1f, 0.2f, 0.3f);
    const std::string colors = "Kd 0.5 0.25 0.125\nKs 0.1 0.2 0.3\nNs 32\nNi 1.5\n";

    Material m = loader.material(colors + "illum 1\nKe 2 # glows\n");
    CHECK(m.diffuse == kd);
    CHECK(m.specular == glm::vec3(0));
    CHECK(m.emission == glm::vec3(2));
    CHECK(m.shininess == 32);
    m = loader.material(colors + "illum 2\n");
    CHECK(m.specular == ks);
    CHECK(m.reflect == glm::vec3(0));
    CHECK(m.transmit == glm::vec3(0));
    m = loader.material(colors + "illum 3\n");
    CHECK(m.reflect == ks);
    CHECK_FALSE(m.fresnel);
    m = loader.material(colors + "illum 5\n");
    CHECK(m.reflect == ks);
    CHECK(m.fresnel);
    m = loader.material(colors + "illum 7\nTf 0.5 1 1\n");
    CHECK(m.diffuse == glm::vec3(0));
    CHECK(m.transmit == glm::vec3(0.5f, 1, 1));
    CHECK(m.ior == 1.5f);
    CHECK(m.fresnel);
    m = loader.material(colors + "d 0.25\n");
    CHECK(m.diffuse == kd * 0.25f);
    CHECK(m.transmit == glm::vec3(0.75f));
    CHECK(loader.material("d -halo 0.25\n").transmit == glm::vec3(0.75f));
    CHECK(loader.material("Tr 0.75\n").transmit == glm::vec3(0.75f));
    CHECK(loader.material("Tr 4\nKt 9 9 9\n").transmit == glm::vec3(1));
    CHECK(loader.material("Pr 0e999\nPm 5\n").reflect == glm::vec3(0.5f));
    CHECK(loader.material("d 1\nTr 0.75\n").transmit == glm::vec3(0));
    m = loader.material(colors + "Pr 0.5\nPm 0\n");
    CHECK(glm::length(m.diffuse - kd / 3.14159265f) < 1e-7f);
    CHECK(m.specular == glm::vec3(0));
    m = loader.material(colors + "Pr 0\nPm 1\n");
    CHECK(m.diffuse == glm::vec3(0));
    CHECK(m.reflect == kd);
    REQUIRE(m.physical.has_value());
    CHECK(m.physical->baseColor == kd);
    CHECK(m.physical->metallic == 1);
    CHECK(m.physical->roughness == 0);
    CHECK(loader.material(colors + "Pm 0\n").physical->roughness == 0.5f);
    CHECK(loader.material(colors + "Pr 0.25\nd 0.5\n").physical->roughness == 0);
    CHECK(loader.material(colors + "Pr 0.25\nd 0.75\n").physical->transmission == 0.25f);
    CHECK_FALSE(loader.material(colors).physical.has_value());
    CHECK(loader.material("").diffuse == glm::vec3(0.5f));
    loader.dir.write("m.mtl", "Kd x\nnewmtl\nKd 1 0 0\nnewmtl b\nKd 0 1 0");
    CHECK(loader.load("mtllib m.mtl\nusemtl\n" + loader.kTriangle).materials.size() == 1);
    CHECK(loader.scene.materials.at(0).diffuse == glm::vec3(1, 0, 0));
    CHECK(loader.diagnostics.warnings.empty());
}

TEST_CASE("bad mtl values are refused with their line") {
    Loader loader;
    const auto error = [&](const std::string& mtl) {
        try {
            loader.material(mtl);
        } catch (const Error& e) {
            return loader.strip(e.what());
        }
        return std::string();
    };
    CHECK(error("\nKd 1 2 x\n") == "m.mtl:3: 'x' after Kd is not a finite number; repair the line");
    CHECK(error("Ns 1e99\n") == "m.mtl:2: '1e99' after Ns is out of range; give 0 or more");
    CHECK(error("Ks -1 0 0\n") == "m.mtl:2: '-1' after Ks is out of range; give 0 or more");
    CHECK(error("d\n") == "m.mtl:2: '' after d is not a finite number; repair the line");
    CHECK(error("Kd -halo 1\n") == "m.mtl:2: '-halo' after Kd is not a finite number; repair the line");
    CHECK(error("Ns " + std::string(101, '0') + "\n").find("is not a finite number") != std::string::npos);
    CHECK(
        error("Pm 1\n") ==
        "m.mtl:1: the integrator 'whitted' cannot draw the metal 'a' with roughness over 0; set Pr to 0 or name another material "
        "in the scene file, or draw with \"integrator\": \"path\"");
    loader.integrator = Integrator::path;
    CHECK(error("Pm 1\n").empty());
    CHECK_FALSE(loader.scene.render.uses(Integrator::whitted));
    CHECK(loader.scene.render.uses(Integrator::wavefront));
}

TEST_CASE("names with blanks and several libraries are found") {
    Loader loader;
    std::filesystem::create_directory(loader.dir.path() / "sub");
    loader.dir.write("a b.mtl", "newmtl My #1 name \nKd 1 0 0\n");
    loader.dir.write("sub/c.mtl", "newmtl other\nKd 0 1 0\nnewmtl unused\n");
    const std::string faces = "usemtl   My #1 name\nf 1 2 3\nusemtl other\nf 3 2 1\nf 1 3 2\n";
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char* libraries : {"mtllib a b.mtl\nmtllib sub\\c.mtl\n", "mtllib a\\ b.mtl none.mtl sub/c.mtl\n"}) {
        const Mesh mesh = loader.load(vertices + faces + libraries);
        REQUIRE(mesh.materials.size() == 2);
        CHECK(loader.scene.materials.size() == 2);
        CHECK(loader.scene.materials[mesh.materials[mesh.faces[0].material]].diffuse == glm::vec3(1, 0, 0));
        CHECK(loader.scene.materials[mesh.materials[mesh.faces[2].material]].diffuse == glm::vec3(0, 1, 0));
        CHECK(loader.diagnostics.warnings.empty());
    }
}

TEST_CASE("what is missing beside an obj file becomes a warning") {
    Loader loader;
    loader.dir.write("m.mtl", "newmtl brick\nKd 1 0 0\nmap_Kd -s 1 1 1 no such.png\n");
    const Mesh mesh = loader.load(
        "mtllib m.mtl\nmtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl brik\nf 1 2 3\nf 3 2 1\nusemtl brick\nf 1 2 "
        "3\n");
    CHECK(mesh.materials.size() == 2);
    std::vector<std::string> warnings;
    for (const std::string& warning : loader.diagnostics.warnings) warnings.push_back(loader.strip(warning));
    const std::vector<std::string> expected = {
        "m.obj:2: warning: there is no material library 'gone.mtl'; its materials become mid-grey",
        "m.obj:6: warning: faces have no usemtl above them; mid-grey is used; a 'material' in the scene file overrides it",
        "m.obj:7: warning: no library has the material 'brik' (near: 'brick'); mid-grey is used; a 'material' in the scene file "
        "overrides it",
        "m.mtl:3: warning: there is no texture 'no such.png'; its colour Kd is used alone",
    };
    REQUIRE(warnings.size() == expected.size());
    for (size_t i = 0; i < expected.size(); ++i) CHECK(warnings[i] == expected[i]);
}

TEST_CASE("a mesh whose own materials nobody wants reads no library") {
    Loader loader;
    loader.dir.write("m.mtl", "newmtl a\nKd x\n");
    const auto path = loader.dir.write("m.obj", "mtllib m.mtl\nusemtl a\n" + loader.kTriangle);
    const Mesh mesh = loadObj(path, false, loader.scene, loader.diagnostics);
    CHECK(mesh.materials.empty());
    CHECK(mesh.faces[0].material == kNone);
    CHECK(loader.scene.materials.empty());
    CHECK(loader.diagnostics.warnings.empty());
}

TEST_CASE("the corpus of nasty obj files loads or is refused in one line") {
    if (!test::haveShared("scenes/real/nasty")) return;
    size_t files = 0, loaded = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sharedDir() / "scenes/real/nasty")) {
        if (entry.path().extension() != ".obj") continue;
        CAPTURE(entry.path().string());
        ++files;
        try {
            Scene scene;
            Diagnostics diagnostics;
            scene.meshes.push_back(loadObj(entry.path(), true, scene, diagnostics));
            Object object;
            object.mesh = 0;
            object.smooth = true;
            scene.objects.push_back(object);
            const Geometry geometry = flatten(scene, diagnostics);
            for (const CornerAttributes& corner : geometry.corners)
                for (const glm::vec3& n : corner.normals) CHECK(std::fabs(glm::length(n) - 1) < 1e-5f);
            ++loaded;
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find('\n') == std::string::npos);
        }
    }
    CHECK(files > 150);
    CHECK(loaded >= 50);
}

TEST_CASE("the corpus of fuzzed mtl files loads or is refused in one line") {
    if (!test::haveShared("scenes/real/nasty/ufbx-fuzz/mtl_fuzz")) return;
    Loader loader;
    for (const auto& entry : std::filesystem::directory_iterator(test::sharedDir() / "scenes/real/nasty/ufbx-fuzz/mtl_fuzz")) {
        CAPTURE(entry.path().string());
        std::ifstream file(entry.path(), std::ios::binary);
        loader.dir.write("m.mtl", std::string(std::istreambuf_iterator<char>(file), {}));
        CHECK(loader.error("mtllib m.mtl\nusemtl Material\n" + loader.kTriangle).find('\n') == std::string::npos);
    }
}

TEST_CASE("known files have known triangle counts") {
    if (!test::haveShared("scenes/real")) return;
    const std::vector<std::pair<const char*, size_t>> table = {
        {"nasty/assimp/concave_polygon.obj", 64},     {"nasty/tinyobjloader/issue-295-trianguation-failure.obj", 28},
        {"nasty/tinyobjloader/issue-319-003.obj", 8}, {"nasty/assimp/box_mat_with_spaces.obj", 12},
        {"meshes/classic/teapot.obj", 6320},          {"meshes/scans/stanford-bunny.obj", 69451},
    };
    for (const auto& [name, faces] : table) {
        CAPTURE(name);
        Scene scene;
        Diagnostics diagnostics;
        CHECK(loadObj(test::sharedDir() / "scenes/real" / name, false, scene, diagnostics).faces.size() == faces);
    }
}

TEST_CASE("the concave polygon of the corpus is tiled") {
    if (!test::haveShared("scenes/real/nasty/assimp/concave_polygon.obj")) return;
    Scene scene;
    Diagnostics diagnostics;
    const auto path = test::sharedDir() / "scenes/real/nasty/assimp/concave_polygon.obj";
    const Mesh mesh = loadObj(path, false, scene, diagnostics);
    double sum = 0;
    glm::dvec3 vectors(0);
    for (const Face& face : mesh.faces) {
        std::vector<glm::dvec3> p;
        for (const Corner& corner : face.corners) p.push_back(mesh.positions[corner.position]);
        vectors += areaVector(p);
        sum += glm::length(areaVector(p));
    }
    CHECK(sum == doctest::Approx(glm::length(vectors)).epsilon(1e-9));
    CHECK(mesh.faces.size() == 64);
}
