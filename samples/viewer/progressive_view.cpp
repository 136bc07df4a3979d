#include "progressive_view.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace {

double nowMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Pixels of the full picture a side of a preview's pixel.
uint32_t coarseness(Size size, double pixelsPerMs, double ms) {
    constexpr double kFirst = 8;
    constexpr double kMost = 16;
    const double pixels = double(size.width) * size.height;
    const double wanted = pixelsPerMs > 0 ? std::sqrt(pixels / (pixelsPerMs * ms)) : kFirst;
    return static_cast<uint32_t>(std::ceil(std::clamp(wanted, 1.0, kMost)));
}

Picture emptyPicture(uint32_t width, uint32_t height) {
    return {width, height, std::vector<float>(size_t{width} * height * 4)};
}

}  // namespace

void ProgressiveView::preview(const minirt_camera& camera, Size size) {
    minirt_end(job_);
    job_ = nullptr;
    samplesDone_ = 0;
    camera_ = camera;
    size_ = size;
    const uint32_t divisor = coarseness(size, pixelsPerMs_, kPreviewMs);
    preview_ = emptyPicture((size.width + divisor - 1) / divisor, (size.height + divisor - 1) / divisor);
    minirt_stats stats = {};
    minirt_render_desc desc = {};
    desc.width = preview_.width;
    desc.height = preview_.height;
    desc.samples = 1;
    desc.camera = &camera_;
    desc.stats = &stats;
    device_.require(minirt_render(scene_, &desc, preview_.rgba.data()), "");
    pixelsPerMs_ = double(preview_.width) * preview_.height / std::max(stats.gpu_ms, 0.01);
}

void ProgressiveView::begin() {
    minirt_render_desc desc = {};
    desc.width = size_.width;
    desc.height = size_.height;
    desc.samples = samples_;
    desc.camera = &camera_;
    desc.max_dispatch_ms = kStepMs;
    device_.require(minirt_begin(scene_, &desc, &job_), "");
    picture_ = emptyPicture(size_.width, size_.height);
    refineMs_ = 0;
}

void ProgressiveView::refine() {
    if (finished()) return;
    if (!job_) begin();
    const double start = nowMs();
    minirt_progress progress = {};
    device_.require(minirt_step(job_, &progress), "");
    refineMs_ += nowMs() - start;
    samplesDone_ = progress.samples_done;
    msPerSample_ = refineMs_ / (progress.fraction * samples_);
}

const Picture& ProgressiveView::picture() {
    if (!job_) return preview_;
    composeFromJob();
    return picture_;
}

void ProgressiveView::composeFromJob() {
    device_.require(minirt_read(job_, picture_.rgba.data()), "");
    if (samplesDone_ > 0) return;
    for (uint32_t y = 0; y < picture_.height; ++y) {
        const size_t previewRow = size_t{y} * preview_.height / picture_.height * preview_.width;
        for (uint32_t x = 0; x < picture_.width; ++x) {
            float* pixel = &picture_.rgba[(size_t{y} * picture_.width + x) * 4];
            const size_t previewColumn = size_t{x} * preview_.width / picture_.width;
            if (pixel[3] == 0) std::copy_n(&preview_.rgba[(previewRow + previewColumn) * 4], 4, pixel);
        }
    }
}
