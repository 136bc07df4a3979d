// From a small scene to its picture: written, baked and rendered.
#pragma once
#include <minirt.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prepared_scene.hpp"

namespace hard_cases {

using Json = nlohmann::ordered_json;
using glm::dvec3;

inline Json at(const dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

/// A square picture from a pinhole.
struct View {
    dvec3 position{0, 0, 1};
    dvec3 target{0};
    double vfov = 40;
    uint32_t size = 64;
    dvec3 up{0, 1, 0};

    /// Unit direction through the centre of a pixel.
    dvec3 direction(uint32_t x, uint32_t y) const;
};

struct Picture {
    uint32_t size = 0;
    std::vector<float> rgba;
    minirt_stats stats = {};

    double at(uint32_t x, uint32_t y, int channel = 0) const {
        return static_cast<double>(rgba[4 * (size_t{y} * size + x) + channel]);
    }
};

/// What a scene has beside its view.
struct Shot {
    View view;
    double background = 0;
    std::string panorama;  // instead
    uint32_t maxDepth = 20;
    Json materials = Json::object();
    Json objects = Json::array();
    Json lights = Json::array();
};

/// Renders with one setting of the levers after the other. What these do not change of a scene is made once, and a picture that comes from the same kernels and
/// data as one before is that one.
class Stage {
public:
    /// Others may have the same compiler.
    Stage(minirt_context* context, minirtc::KernelCompiler& compiler);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// From now on.
    void set(const minirtc::LeverSettings& levers) { levers_ = levers; }
    /// Forgets all scenes and pictures.
    void clear();

    /// A file that a scene names.
    void write(const std::string& name, const std::string& text);
    /// Throws std::runtime_error with what the compiler or the runtime says.
    Picture render(const Shot& shot);

private:
    struct Known {
        minirtc::PreparedScene scene;
        std::map<std::vector<uint32_t>, Picture> pictures;  // by minirtc::contentOf
    };

    Known& prepare(const std::string& text);
    minirtc::Choices choicesFor(const minirtc::PreparedScene& scene) const;
    Picture shoot(const std::vector<uint8_t>& blob, const View& view) const;

    minirt_context* context_;
    minirtc::KernelCompiler& compiler_;
    minirtc::LeverSettings levers_;
    std::filesystem::path folder_;
    std::map<std::string, std::string> files_;
    std::map<std::pair<std::string, std::map<std::string, std::string>>, Known> known_;  // by the scene and its files
};

/// Share of pixels for which `is` holds, in percent.
template <typename F>
double percentOf(const Picture& picture, F is) {
    size_t count = 0;
    for (uint32_t y = 0; y < picture.size; ++y)
        for (uint32_t x = 0; x < picture.size; ++x) count += is(x, y) ? 1 : 0;
    return 100.0 * static_cast<double>(count) / (static_cast<double>(picture.size) * picture.size);
}

/// Largest value over all pixels.
template <typename F>
double largestOf(const Picture& picture, F value) {
    double largest = 0;
    for (uint32_t y = 0; y < picture.size; ++y)
        for (uint32_t x = 0; x < picture.size; ++x) largest = std::max(largest, static_cast<double>(value(x, y)));
    return largest;
}

}  // namespace hard_cases
