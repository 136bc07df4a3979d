// A GPU keeps quantised nodes unpacked, 64 bytes each, as long as there are not too many. Here the device acts as one.
#include <doctest/doctest.h>

#include "runtime_hooks.hpp"
#include "scene_text.hpp"

using test::GpuContext;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

constexpr uint64_t kMostNodes = (64u << 20) / 64;

/// Glass, mirror and shadows over a floor of many facets.
std::string facets(const TemporaryDir& dir) {
    std::string obj;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            obj += "v " + test::json(0.3 * i - 3) + " " + test::json(0.02 * (i * 7 % 5 + j * 3 % 4)) + " " +
                   test::json(0.3 * j - 3) + "\n";
    for (int i = 1; i < 20; ++i)
        for (int j = 1; j < 20; ++j) {
            const int last = 20 * i + j + 1;
            obj += "f " + std::to_string(last - 21) + " " + std::to_string(last - 20) + " " + std::to_string(last) + " " +
                   std::to_string(last - 1) + "\n";
        }
    dir.write("facets.obj", obj);
    return R"({"camera":{"position":[0,2,5],"target":[0,0,0],"vfov":45},"render":{"size":[40,40],"maxDepth":6},"background":{"color":[0.2,0.3,0.5]},
        "lights":[{"type":"point","position":[3,4,2],"intensity":[20,20,20]}],
        "materials":{"glass":{"model":"pbr","roughness":0,"transmission":1},"mirror":{"model":"phong","diffuse":0.1,"reflect":0.8},
                     "matt":{"model":"phong","color":[0.7,0.3,0.2]}},
        "objects":[{"mesh":"facets.obj","material":"matt"},{"sphere":{"center":[-0.6,0.6,0],"radius":0.5},"material":"glass"},
                   {"sphere":{"center":[0.7,0.6,0.2],"radius":0.5},"material":"mirror"}]})";
}

}  // namespace

TEST_CASE("nodes are kept unpacked up to 64 MB of them") {
    GpuContext gpu;
    if (!gpu) return;
    test::specialiseAsGpu(gpu.get());
    for (const uint64_t nodes : {uint64_t{1}, kMostNodes - 1, kMostNodes}) CHECK(test::keepsWideNodes(gpu.get(), nodes));
    for (const uint64_t nodes : {kMostNodes + 1, 2 * kMostNodes, uint64_t{1} << 40})
        CHECK_FALSE(test::keepsWideNodes(gpu.get(), nodes));
    CHECK_FALSE(test::keepsWideNodes(gpu.get(), 1, true));
}

TEST_CASE("a device's own limits of buffers keep nodes packed") {
    GpuContext gpu;
    if (!gpu) return;
    test::specialiseAsGpu(gpu.get());
    const uint32_t usual = test::limitStorage(gpu.get(), 6400);
    CHECK(test::keepsWideNodes(gpu.get(), 100));
    CHECK_FALSE(test::keepsWideNodes(gpu.get(), 101));
    test::limitStorage(gpu.get(), usual);
    test::limitTexels(gpu.get(), 400);
    CHECK(test::keepsWideNodes(gpu.get(), 100));
    CHECK_FALSE(test::keepsWideNodes(gpu.get(), 101));
}

TEST_CASE("a processor's nodes stay packed") {
    GpuContext gpu;
    if (!gpu || !gpu.isCpu()) return;
    CHECK_FALSE(test::keepsWideNodes(gpu.get(), 1));
}

TEST_CASE("pictures over packed and unpacked nodes are the same bit for bit") {
    TemporaryDir dir;
    const std::filesystem::path blob = test::bakeScene(dir, facets(dir));
    Picture pictures[2];
    for (const bool wide : {false, true}) {
        GpuContext gpu;
        if (!gpu) return;
        test::specialiseAsGpu(gpu.get());
        const uint32_t usual = test::limitStorage(gpu.get(), 0);  // in which no node has room
        if (wide) test::limitStorage(gpu.get(), usual);
        const LoadedScene scene(gpu, blob);
        test::limitStorage(gpu.get(), usual);
        CHECK(test::hasWideNodes(scene.get()) == wide);
        pictures[wide] = scene.render();
    }
    CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("a device without memory for unpacked nodes is reported and nothing leaks") {
    TemporaryDir dir;
    const std::filesystem::path blob = test::bakeScene(dir, facets(dir));
    GpuContext gpu;  // whose validation layer misses what is not released
    if (!gpu) return;
    test::specialiseAsGpu(gpu.get());
    test::refuseDeviceMemory(gpu.get());
    minirt_scene* scene = nullptr;
    CHECK(minirt_load_file(gpu.get(), blob.string().c_str(), &scene) == MINIRT_ERROR_DEVICE_OUT_OF_MEMORY);
    CHECK(scene == nullptr);
    CHECK_FALSE(gpu.takeMessages().empty());
}
