// Triangles that the builder has split are surfaces as before: pictures equal those over whole ones bit for bit, whatever is counted on the way.
#include <doctest/doctest.h>

#include "bvh.hpp"
#include "geometry.hpp"
#include "scene.hpp"
#include "scene_text.hpp"

using test::bakeScene;
using test::GpuContext;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

std::string vertex(const glm::dvec3& p) {
    return "v " + test::json(p.x) + " " + test::json(p.y) + " " + test::json(p.z) + "\n";
}

/// Thin closed beams, askew to all axes, none of which touches another.
std::string beams() {
    constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const glm::dvec3 along = glm::normalize(glm::dvec3(1, 0.9, 0.8)), u = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
    const glm::dvec3 v = glm::cross(along, u);
    std::string obj;
    for (int i = 0; i < 81; ++i) {
        const glm::dvec3 start = -1.2 * along + 0.17 * (i % 9 - 4) * u + 0.17 * (i / 9 - 4) * v;
        for (int corner = 0; corner < 8; ++corner)
            obj +=
                vertex(start + (corner & 1 ? 0.03 : 0.0) * u + (corner & 2 ? 0.03 : 0.0) * v + (corner & 4 ? 2.4 : 0.0) * along);
        for (const auto& face : kFaces) {
            obj += "f";
            for (const int corner : face) obj += " " + std::to_string(8 * i + corner + 1);
            obj += "\n";
        }
    }
    return obj;
}

std::string sceneOf(const std::string& render, const std::string& beam) {
    return R"({"camera":{"position":[0.3,0.6,4],"target":[0,0,0],"vfov":40},"background":{"color":[0.2,0.3,0.4]},)"
           R"("lights":[{"type":"point","position":[1,4,2],"intensity":[20,18,16]}],"render":{"size":[48,48],)" +
           render + R"(},"materials":{"m":)" + beam + R"(,"floor":{"model":"pbr","baseColor":[0.7,0.6,0.5]}},)" +
           R"("objects":[{"mesh":"beams.obj","material":"m"},{"rectangle":{"origin":[-5,-1.8,5],"u":[10,0,0],"v":[0,0,-10]},"material":"floor"}]})";
}

void checkSplit(const TemporaryDir& dir, const std::string& json) {
    minirtc::Diagnostics diagnostics;
    const minirtc::Geometry geometry =
        minirtc::flatten(minirtc::loadScene(dir.write("scene.json", json), diagnostics), diagnostics);
    REQUIRE(minirtc::buildBvh(geometry, 0).order.size() > geometry.primitives.size() + 30);
}

Picture pictureOf(const GpuContext& gpu, const TemporaryDir& dir, const std::string& json, minirtc::BvhQuality quality) {
    minirtc::BakeOptions options;
    options.bvh = quality;
    options.onlyDefault = true;
    return LoadedScene(gpu, bakeScene(dir, json, quality == minirtc::BvhQuality::fast ? "whole" : "split", options)).render();
}

}  // namespace

TEST_CASE("split triangles give the same picture bit for bit") {
    GpuContext gpu;
    if (!gpu) return;
    const std::string glass =
        R"({"model":"pbr","ior":1.5,"transmission":1,"roughness":0,"attenuationColor":[0.2,0.8,0.4],"attenuationDistance":0.05})";
    const std::string veil = R"({"model":"pbr","baseColor":[0.8,0.5,0.3],"alpha":0.5,"alphaMode":"blend","doubleSided":true})";
    const std::string matte = R"({"model":"pbr","baseColor":[0.8,0.5,0.3]})";
    const std::string path = R"("integrator":"path","spp":8,"maxDepth":6)", whitted = R"("maxDepth":12)";
    for (const auto& [render, material] : {std::pair(whitted, matte), std::pair(whitted, glass), std::pair(whitted, veil),
                                           std::pair(path, matte), std::pair(path, glass), std::pair(path, veil)}) {
        CAPTURE(render);
        CAPTURE(material);
        TemporaryDir dir;
        dir.write("beams.obj", beams());
        const std::string json = sceneOf(render, material);
        checkSplit(dir, json);
        const Picture whole = pictureOf(gpu, dir, json, minirtc::BvhQuality::fast);
        CHECK(whole == pictureOf(gpu, dir, json, minirtc::BvhQuality::high));
    }
}
