#include "render_scene.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <stdexcept>

namespace test {
namespace {

void require(const GpuContext& gpu, minirt_result result) {
    if (result) throw std::runtime_error(std::string(minirt_result_string(result)) + ": " + minirt_last_message(gpu.get()));
}

}  // namespace

bool Picture::operator==(const Picture& other) const {
    return width == other.width && height == other.height &&
           std::memcmp(rgba.data(), other.rgba.data(), rgba.size() * sizeof(float)) == 0;
}

std::filesystem::path bakeScene(const TemporaryDir& dir, const std::string& json, const std::string& name,
                                minirtc::BakeOptions options) {
    options.scene = dir.write(name + ".json", json).string();
    options.output = (dir.path() / (name + ".mrt")).string();
    options.quiet = true;
    static minirtc::KernelCompiler compiler(0);  // scenes of a case that differ in their data alone have the same kernels
    options.compiler = &compiler;
    minirtc::bake(options);
    return options.output;
}

std::filesystem::path bakeScene(const TemporaryDir& dir, const std::string& json, minirtc::LayoutChoice layout, Kernels kernels) {
    minirtc::BakeOptions options;
    options.layout = layout;
    options.onlyDefault = kernels == Kernels::ofDefault;
    return bakeScene(dir, json, "scene", options);
}

LoadedScene::LoadedScene(const GpuContext& gpu, const std::filesystem::path& blob) : gpu_(gpu) {
    require(gpu, minirt_load_file(gpu.get(), blob.string().c_str(), &scene_));
}

LoadedScene::~LoadedScene() {
    minirt_unload(scene_);
}

Picture LoadedScene::render(minirt_render_desc desc) const {
    minirt_scene_desc defaults;
    minirt_get_scene_desc(scene_, &defaults);
    Picture picture;
    picture.width = desc.width ? desc.width : defaults.width;
    picture.height = desc.height ? desc.height : defaults.height;
    picture.rgba.resize(size_t{picture.width} * picture.height * 4);
    desc.stats = &picture.stats;
    require(gpu_, minirt_render(scene_, &desc, picture.rgba.data()));
    CHECK(picture.stats.nan_pixels == 0);
    CHECK(picture.stats.segment_overflow == 0);
    CHECK(picture.stats.volume_overflow == 0);
    CHECK(picture.stats.traversal_cap == 0);
    return picture;
}

Picture renderScene(const GpuContext& gpu, const TemporaryDir& dir, const std::string& json) {
    return LoadedScene(gpu, bakeScene(dir, json)).render();
}

Picture renderScene(const GpuContext& gpu, const std::string& json) {
    return renderScene(gpu, TemporaryDir(), json);
}

Picture renderWithAllEffects(const GpuContext& gpu, const TemporaryDir& dir, const std::string& json) {
    minirtc::BakeOptions options;
    options.choices.allEffects = true;
    options.onlyDefault = true;
    return LoadedScene(gpu, bakeScene(dir, json, "all", options)).render();
}

}  // namespace test
