#include "scene_text.hpp"

#include <doctest/doctest.h>

#include <cmath>

using glm::dvec3;

namespace test {

std::string json(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

std::string json(const dvec3& v) {
    return "[" + json(v.x) + "," + json(v.y) + "," + json(v.z) + "]";
}

std::string quoted(const std::string& key) {
    return "\"" + key + "\":";
}

std::string View::text() const {
    return quoted("camera") + "{" + quoted("position") + json(position) + "," + quoted("target") + json(target) + "," +
           quoted("up") + json(up) + "," + quoted("vfov") + json(vfov) + "}," + quoted("render") + "{" + quoted("size") + "[" +
           json(size) + "," + json(size) + "]," + quoted("maxDepth") + json(maxDepth) + "," + quoted("spp") + json(samples) + "}";
}

dvec3 View::direction(uint32_t x, uint32_t y) const {
    const dvec3 forward = glm::normalize(target - position), right = glm::normalize(glm::cross(forward, up));
    const double half = std::tan(glm::radians(vfov) / 2);
    const double u = ((x + 0.5) / size * 2 - 1) * half, v = ((y + 0.5) / size * 2 - 1) * half;
    return glm::normalize(forward + u * right - v * glm::cross(right, forward));
}

std::string rectangle(const dvec3& origin, const dvec3& u, const dvec3& v, const std::string& material) {
    return "{" + quoted("rectangle") + "{" + quoted("origin") + json(origin) + "," + quoted("u") + json(u) + "," + quoted("v") +
           json(v) + "}," + quoted("material") + "\"" + material + "\"}";
}

std::string sphere(const dvec3& center, double radius, const std::string& material) {
    return "{" + quoted("sphere") + "{" + quoted("center") + json(center) + "," + quoted("radius") + json(radius) + "}," +
           quoted("material") + "\"" + material + "\"}";
}

std::string floorOf(const std::string& material) {
    return rectangle({-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, material);
}

std::string box(const TemporaryDir& dir, const std::string& name, const dvec3& lo, const dvec3& hi, const std::string& material) {
    std::string obj;
    for (int i = 0; i < 8; ++i) {
        const dvec3 p(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
        obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    dir.write(name + ".obj", obj);
    return R"({"mesh":")" + name + R"(.obj","material":")" + material + "\"}";
}

std::string glow(double radiance) {
    return R"({"model":"pbr","baseColor":[0,0,0],"emissive":)" + json(dvec3(radiance)) + "}";
}

std::string glass(double ior) {
    return R"({"model":"pbr","roughness":0,"transmission":1,"ior":)" + json(ior) + "}";
}

std::string pointLight(const dvec3& position, const dvec3& intensity, const std::string& falloff) {
    return R"({"type":"point","position":)" + json(position) + R"(,"intensity":)" + json(intensity) + R"(,"falloff":")" +
           falloff + "\"}";
}

minirt_render_desc depthLimit(uint32_t maxDepth) {
    minirt_render_desc desc = {};
    desc.max_depth = maxDepth + 1;  // 0 means the scene's
    return desc;
}

void checkPixels(const Picture& picture, double tolerance,
                 const std::function<std::optional<dvec3>(uint32_t, uint32_t)>& expected, double least) {
    double worst = 0;
    size_t compared = 0;
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x) {
            const std::optional<dvec3> value = expected(x, y);
            if (!value) continue;
            compared++;
            for (int k = 0; k < 3; ++k) {
                const double error = std::abs(picture.at(x, y)[k] - (*value)[k]) / std::max(std::abs((*value)[k]), least);
                INFO("pixel " << x << " " << y << " channel " << k << ": " << picture.at(x, y)[k] << " instead of "
                              << (*value)[k]);
                if (!(error <= tolerance) && worst <= tolerance) CHECK(error <= tolerance);
                worst = std::max(worst, error);
            }
        }
    MESSAGE("largest error " << worst << " of " << compared << " pixels");
    CHECK(worst <= tolerance);
    CHECK(compared * 4 > size_t{picture.width} * picture.height);
}

double fresnel(double cosI, double eta) {
    const double sin2T = (1 - cosI * cosI) / (eta * eta);
    if (sin2T >= 1) return 1;
    const double cosT = std::sqrt(1 - sin2T);
    const double parallel = (eta * cosI - cosT) / (eta * cosI + cosT), perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
    return (parallel * parallel + perpendicular * perpendicular) / 2;
}

}  // namespace test
