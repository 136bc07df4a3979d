// The sample shapes are what nested volumes need: closed, oriented outward, of the size they claim.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "aquarium.hpp"
#include "cornell.hpp"
#include "decanter.hpp"
#include "fish.hpp"
#include "foliage.hpp"
#include "gems.hpp"
#include "generate.hpp"
#include "ice.hpp"
#include "knot.hpp"
#include "lathe.hpp"
#include "polyhedron.hpp"
#include "scene.hpp"
#include "scene_files.hpp"
#include "sheet.hpp"
#include "sphere.hpp"
#include "support.hpp"
#include "vessels.hpp"
#include "volumes.hpp"

namespace {

constexpr double kPi = glm::pi<double>();

samples::Tumbler flutedTumbler() {
    samples::Tumbler shape;
    shape.flutes = 16;
    return shape;
}

/// Reads back positions and faces; enough of the format for the generator's own files.
samples::Mesh readObj(const std::filesystem::path& path) {
    samples::Mesh mesh;
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            glm::dvec3 p;
            words >> p.x >> p.y >> p.z;
            mesh.positions.push_back(p);
        } else if (word == "f") {
            std::vector<uint32_t> face;
            while (words >> word) face.push_back(static_cast<uint32_t>(std::stoul(word) - 1));
            mesh.faces.push_back(samples::makeFace(face));
        }
    }
    return mesh;
}

/// All samples, written once for the cases that read them.
const std::filesystem::path& generated() {
    static const test::TemporaryDir folder;
    static const std::filesystem::path path = [] {
        samples::generate(folder.path());
        return folder.path();
    }();
    return path;
}

std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::ifstream file(entry.path(), std::ios::binary);
        files[entry.path().filename().string()] = std::string(std::istreambuf_iterator<char>(file), {});
    }
    return files;
}

}  // namespace

TEST_CASE("every sample mesh but the cards is a closed manifold that faces outward as written to its file") {
    const std::set<std::string> cards{"shrub_leaves.obj", "meadow.obj"};
    const std::filesystem::path& folder = generated();
    int meshes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".obj" || cards.count(entry.path().filename().string()) > 0) continue;
        CAPTURE(entry.path().filename().string());
        const samples::Mesh mesh = readObj(entry.path());
        CHECK(samples::manifoldDefect(mesh) == "");
        CHECK(samples::signedVolume(mesh) > 0);
        ++meshes;
    }
    CHECK(meshes >= 31);
}

TEST_CASE("two runs of the generator write the same bytes") {
    const test::TemporaryDir second;
    samples::generate(second.path() / "made" / "on the way");
    CHECK(contents(generated()) == contents(second.path() / "made" / "on the way"));
}

TEST_CASE("the generator writes every scene file unchanged") {
    const std::filesystem::path& folder = generated();
    const auto written = contents(folder);
    const auto source = contents(std::filesystem::path(MINIRT_SOURCE_DIR) / "samples" / "scenes");
    REQUIRE(samples::sceneFiles().size() >= 12);
    for (const auto& [name, text] : samples::sceneFiles()) {
        CAPTURE(name);
        CHECK(written.at(name) == source.at(name));
    }
}

TEST_CASE("every sample scene loads without a warning, its volumes closed and in an order that is no guess") {
    const std::filesystem::path& folder = generated();
    for (const auto& [name, text] : samples::sceneFiles()) {
        CAPTURE(name);
        minirtc::Diagnostics diagnostics;
        const minirtc::Scene scene = minirtc::loadScene(folder / name, diagnostics);
        const minirtc::Geometry geometry = minirtc::flatten(scene, diagnostics);
        minirtc::analyseVolumes(scene, geometry, diagnostics);
        CHECK(diagnostics.warnings == std::vector<std::string>{});
    }
}

TEST_CASE("the compiler finds what displaces what in the sample scenes") {
    const std::filesystem::path& folder = generated();
    const auto displacements = [&](const std::string& name) {
        minirtc::Diagnostics diagnostics;
        const minirtc::Scene scene = minirtc::loadScene(folder / name, diagnostics);
        const minirtc::Geometry geometry = minirtc::flatten(scene, diagnostics);
        std::set<std::string> found;
        for (const minirtc::Displacement& pair : minirtc::analyseVolumes(scene, geometry, diagnostics).displacements) {
            const auto material = [&](uint32_t body) { return scene.materials[geometry.bodies[body].material].name; };
            found.insert(material(pair.above) + " in " + material(pair.below));
        }
        return found;
    };
    CHECK(displacements("whisky.json") == std::set<std::string>{"glass in whisky", "ice in whisky"});
    CHECK(displacements("fish_tank.json") == std::set<std::string>{"air in water", "glass in water"});
    CHECK(displacements("studio_shot.json") == std::set<std::string>{"glass in liqueur"});
    CHECK(displacements("diamond.json").empty());
}

TEST_CASE("manifoldDefect names a hole and a flipped face") {
    samples::Mesh open = samples::prism(3, 1, 1);
    open.faces.pop_back();
    CHECK(samples::manifoldDefect(open).find("no opposite") != std::string::npos);
    samples::Mesh flipped = samples::prism(3, 1, 1);
    std::reverse(flipped.faces[0].begin(), flipped.faces[0].end());
    CHECK(samples::manifoldDefect(flipped).find("2 times") != std::string::npos);
}

TEST_CASE("the volume of a prism is its base times its height") {
    CHECK(samples::signedVolume(samples::prism(3, 2, 5)) == doctest::Approx(std::sqrt(3.0) * 5));
    CHECK(samples::signedVolume(samples::prism(4, 2, 5)) == doctest::Approx(4 * 5));
    CHECK(samples::signedVolume(samples::prism(6, 2, 5)) == doctest::Approx(1.5 * std::sqrt(3.0) * 4 * 5));
}

TEST_CASE("the volume of a turned cylinder is that of the regular prism it is made of") {
    constexpr int kSegments = 24;
    const double base = 0.5 * kSegments * std::sin(2 * kPi / kSegments) * 9;
    CHECK(samples::signedVolume(samples::lathe({{0, 0}, {3, 0}, {3, 7}, {0, 7}}, kSegments)) == doctest::Approx(base * 7));
}

TEST_CASE("sphere, rounded box and knot approach their closed forms from below") {
    const auto fallsShort = [](const samples::Mesh& mesh, double exact, double relative) {
        const double volume = samples::signedVolume(mesh);
        CHECK(volume < exact);
        CHECK(volume > exact * (1 - relative));
    };
    fallsShort(samples::icosphere(4), 4 * kPi / 3, 0.004);
    const double r = 0.25;  // of a box whose flat core is 1.5 x 2.5 x 3.5
    const double rounding =
        2 * r * (1.5 * 2.5 + 2.5 * 3.5 + 3.5 * 1.5) + kPi * r * r * (1.5 + 2.5 + 3.5) + 4 * kPi / 3 * r * r * r;
    fallsShort(samples::roundedBox({2, 3, 4}, r, 8), 1.5 * 2.5 * 3.5 + rounding, 0.002);
    samples::TorusKnot torus;  // unknotted: Pappus
    torus.p = 1;
    torus.q = 0;
    torus.ringRadius = 2;
    torus.windingRadius = 0.5;
    fallsShort(samples::torusKnot(torus), 2 * kPi * 2.5 * kPi * torus.tubeRadius * torus.tubeRadius, 0.01);
}

TEST_CASE("the brilliant has 57 facets and a girdle") {
    const samples::Mesh gem = samples::brilliantCut();
    int crown = 0;
    int girdle = 0;
    int pavilion = 0;
    for (const samples::Face& face : gem.faces) {
        const double up = glm::normalize(samples::areaVector(gem, face)).y;
        ++(up > 0.1 ? crown : up < -0.1 ? pavilion : girdle);
    }
    CHECK(crown == 1 + 8 + 8 + 16);
    CHECK(pavilion == 16 + 8);
    CHECK(girdle == samples::kBrilliantGirdleFacets);
}

TEST_CASE("the step cut has three rows of facets on either side of the girdle") {
    const samples::Mesh gem = samples::stepCut(1, 1);
    CHECK(gem.faces.size() == 1 + 8 * 7);
}

TEST_CASE("the filling reaches into the tumbler but not through it") {
    const samples::Tumbler shape;
    const samples::Mesh filling = samples::tumblerFilling(shape, 0.05, 0.0003);
    double lowest = 1;
    for (const glm::dvec3& p : filling.positions) {
        const double outside = glm::mix(shape.bottomRadius, shape.topRadius, p.y / shape.height);
        CHECK(std::hypot(p.x, p.z) < outside - shape.wall / 2);
        lowest = std::min(lowest, p.y);
    }
    CHECK(lowest == doctest::Approx(shape.base - 0.0003));
}

TEST_CASE("the water reaches into the walls of the tank but not through them, the sand less far") {
    const samples::Aquarium shape;
    const auto reach = [&](const samples::Mesh& mesh) {
        double most = -1;
        for (const glm::dvec3& p : mesh.positions) {
            most = std::max({most, std::abs(p.x) - shape.halfWidth, std::abs(p.z) - shape.halfDepth, -p.y});
            CHECK(p.y < shape.height);
        }
        return most;
    };
    CHECK(reach(samples::tankWater(shape)) == doctest::Approx(shape.overlap));
    CHECK(reach(samples::tankSand(shape)) == doctest::Approx(shape.overlap / 2));
    CHECK(shape.overlap < shape.wall);
}

TEST_CASE("the volume of the tank is that of its outside less that of its inside") {
    const samples::Aquarium shape;
    const double outside = 4 * (shape.halfWidth + shape.wall) * (shape.halfDepth + shape.wall) * (shape.height + shape.wall);
    const double inside = 4 * shape.halfWidth * shape.halfDepth * shape.height;
    CHECK(samples::signedVolume(samples::tank(shape)) == doctest::Approx(outside - inside));
}

TEST_CASE("a relief over a level floor is a box, and a leaf of even thickness has its outline's area times that") {
    const auto level = [](double, double) { return 2.0; };
    CHECK(samples::signedVolume(samples::relief(3, 4, -1, 5, 7, level)) == doctest::Approx(6 * 8 * 3));
    const auto flat = [](double u, double v) { return samples::LeafPoint{{2 * u, 3 * v, 0}, {0, 0, 0.05}}; };
    const double volume = samples::signedVolume(samples::leaf(200, 200, flat));
    CHECK(volume < 2 * 3 * 0.1);
    CHECK(volume == doctest::Approx(2 * 3 * 0.1).epsilon(0.02));  // the edges all around are sharp
}

TEST_CASE("fish are as long as they claim, their two sides alike before they bend") {
    for (const auto species : {samples::Species::clownfish, samples::Species::tang, samples::Species::butterflyfish}) {
        const samples::Mesh fish = samples::fish(species, 0);
        double front = 0, back = 0, left = 0, right = 0;
        for (const glm::dvec3& p : fish.positions) {
            front = std::max(front, p.x), back = std::min(back, p.x);
            left = std::min(left, p.z), right = std::max(right, p.z);
        }
        CHECK(front == doctest::Approx(0.5));
        CHECK(front - back == doctest::Approx(1).epsilon(0.06));
        CHECK(right == doctest::Approx(-left).epsilon(0.1));
    }
}

TEST_CASE("the studio is dark with lamps in it") {
    const samples::Picture picture = samples::studio(256, 128);
    size_t dark = 0, bright = 0;
    for (const glm::vec3& pixel : picture.pixels) {
        dark += pixel.g < 0.1F ? 1 : 0;
        bright += pixel.g > 10 ? 1 : 0;
    }
    CHECK(dark > picture.pixels.size() / 2);
    CHECK(bright > 20);
    CHECK(bright < picture.pixels.size() / 50);
}

TEST_CASE("fluting removes glass") {
    CHECK(samples::signedVolume(samples::tumbler(flutedTumbler())) < samples::signedVolume(samples::tumbler({})));
}

TEST_CASE("normals are shared where the surface is smooth and split at creases") {
    samples::Mesh box = samples::prism(4, 1, 1);
    samples::addNormals(box, 30);
    CHECK(box.normals.size() == 24);
    samples::addNormals(box, 180);
    CHECK(box.normals.size() == 8);
    for (const samples::Corner& corner : box.faces[0]) {
        CHECK(glm::dot(box.normals[corner.normal], glm::normalize(box.positions[corner.position])) == doctest::Approx(1));
    }
}

TEST_CASE("the blocks of the Cornell box have the measured sizes, and the room has the measured corners") {
    CHECK(samples::signedVolume(samples::cornellShortBlock()) == doctest::Approx(0.165 * 0.165 * 0.165).epsilon(0.01));
    CHECK(samples::signedVolume(samples::cornellTallBlock()) == doctest::Approx(0.165 * 0.165 * 0.330).epsilon(0.01));
    glm::dvec3 least(1), most(-1);
    for (const samples::Mesh& part : {samples::cornellRoom(), samples::cornellLeft(), samples::cornellRight()}) {
        for (const glm::dvec3& p : part.positions) least = glm::min(least, p), most = glm::max(most, p);
    }
    CHECK(glm::distance(least, glm::dvec3(-0.01, -0.01, 0)) < 1e-9);
    CHECK(glm::distance(most, glm::dvec3(0.566, 0.5588, 0.5692)) < 1e-9);
}

TEST_CASE("the lamps over the plates have one power") {
    const std::filesystem::path& folder = generated();
    minirtc::Diagnostics diagnostics;
    const minirtc::Scene scene = minirtc::loadScene(folder / "mis.json", diagnostics);
    std::vector<double> powers;
    for (const minirtc::Object& object : scene.objects) {
        const glm::dvec3 emission(scene.materials[object.material].emission);
        if (emission == glm::dvec3(0) || object.sphere.center.y > 5) continue;  // the fifth stands over the camera
        powers.push_back(glm::dot(emission, glm::dvec3(0.2126, 0.7152, 0.0722)) * object.sphere.radius * object.sphere.radius);
    }
    REQUIRE(powers.size() == 4);
    for (const double power : powers) CHECK(power == doctest::Approx(powers[0]).epsilon(0.01));
}

TEST_CASE("cards are quads with a picture each, and the pictures have holes with hard edges") {
    for (const samples::Mesh& mesh : {samples::shrubLeaves(), samples::meadow(2, 50)}) {
        CHECK(mesh.faces.size() >= 100);
        CHECK(mesh.uvs.size() == mesh.positions.size());
        for (const samples::Face& face : mesh.faces) {
            CHECK(face.size() == 4);
            CHECK(glm::length(samples::areaVector(mesh, face)) > 1e-3);
        }
    }
    for (const samples::Picture& picture : {samples::leafCard(256), samples::grassCard(256)}) {
        REQUIRE(picture.alpha.size() == picture.pixels.size());
        double cover = 0, between = 0;
        for (const float alpha : picture.alpha) {
            cover += double{alpha} / static_cast<double>(picture.alpha.size());
            between += alpha > 0 && alpha < 1 ? 1.0 / static_cast<double>(picture.alpha.size()) : 0;
        }
        CHECK(cover > 0.15);
        CHECK(cover < 0.7);
        CHECK(between < 0.05);
    }
}

TEST_CASE("the liqueur reaches into the decanter but not through it, and the stopper touches no glass") {
    const samples::Mesh glass = samples::decanter();
    for (const glm::dvec3& p : samples::decanterFilling().positions) {
        CHECK(std::hypot(p.x, p.z) < 0.0495 - 0.002);
        CHECK(p.y > 0.010);
    }
    double nearest = 1;
    for (const glm::dvec3& p : samples::decanterStopper().positions)
        for (const glm::dvec3& q : glass.positions) nearest = std::min(nearest, glm::distance(p, q));
    CHECK(nearest > 0.0004);
    CHECK(samples::signedVolume(glass) < 0.00025);
}

TEST_CASE("brushed brass has unit normals about +Z and a roughness under 0.4") {
    for (const glm::vec3& pixel : samples::brushedNormals(64, 64).pixels) {
        CHECK(glm::length(2.0F * pixel - 1.0F) == doctest::Approx(1).epsilon(1e-5));
        CHECK(pixel.b > 0.95F);
    }
    for (const glm::vec3& pixel : samples::brushedSurface(64, 64).pixels) {
        CHECK(pixel.g > 0.15F);
        CHECK(pixel.g < 0.4F);
        CHECK(pixel.b == 1);
    }
}
