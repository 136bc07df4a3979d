#include "viewer.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace {

constexpr double kIdleSeconds = 0.05;
constexpr double kLongestFrame = 0.1;     // a hitch is no leap
constexpr double kRestSeconds = 0.15;     // without motion before the view refines
constexpr double kRefreshSeconds = 0.25;  // between pictures of a refining view

minirt_scene_desc describe(minirt_scene* scene) {
    minirt_scene_desc desc;
    minirt_get_scene_desc(scene, &desc);
    return desc;
}

}  // namespace

double Stopwatch::restart() {
    const double passed = seconds();
    start_ = std::chrono::steady_clock::now();
    return passed;
}

Viewer::Viewer(const ViewerDesc& desc, Device& device, minirt_scene* scene)
    : desc_(desc), window_(desc.name, desc.size), view_(device, scene, desc.samples), camera_(describe(scene)) {}

void Viewer::run() {
    while (!window_.shouldClose()) {
        const Size size = window_.size();
        const bool minimised = size.width == 0 || size.height == 0;
        window_.poll(minimised || view_.finished() ? kIdleSeconds : 0);
        const double seconds = std::min(frame_.restart(), kLongestFrame);
        if (minimised) continue;
        if (moveCamera(seconds) || !(size == shown_))
            preview(size);
        else if (!view_.finished())
            refine();
        if (window_.takeSaveRequest()) save(freeName());
        if (view_.finished() && !desc_.screenshot.empty()) return save(desc_.screenshot);
    }
}

bool Viewer::moveCamera(double seconds) {
    if (desc_.script.running()) return desc_.script.play(camera_);
    const Window::Drag drag = window_.takeDrag();
    const bool turned = camera_.turn(drag.right, drag.down);
    return camera_.fly(window_.motion(), seconds) || turned;
}

void Viewer::preview(Size size) {
    view_.preview(camera_.camera(), size);
    shown_ = size;
    show();
    rest_.restart();
}

void Viewer::refine() {
    if (rest_.seconds() < kRestSeconds) return window_.poll(kRestSeconds / 10);
    view_.refine();
    if (view_.finished() || refresh_.seconds() > kRefreshSeconds) show();
}

void Viewer::show() {
    window_.show(view_.picture());
    char title[64] = ": preview";
    if (view_.samplesDone() > 0)
        std::snprintf(title, sizeof title, ": %u samples, %.1f ms each", view_.samplesDone(), view_.msPerSample());
    window_.setTitle(desc_.name + title);
    refresh_.restart();
}

void Viewer::save(const std::string& path) {
    const Image8 image = window_.pixels();
    const std::string problem = writePng(path, image.width, image.height, image.rgb);
    if (!problem.empty()) throw std::runtime_error(problem);
}

/// NAME-1.png, or the first higher number that is free in the working folder.
std::string Viewer::freeName() const {
    int number = 1;
    std::string name;
    do {
        name = desc_.name + "-" + std::to_string(number++) + ".png";
    } while (std::filesystem::exists(name));
    return name;
}
