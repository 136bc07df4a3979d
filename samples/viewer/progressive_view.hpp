// What the camera sees: coarse at once, then ever finer.
#pragma once
#include <optional>
#include <vector>

#include "../common/device.hpp"
#include "../common/picture_file.hpp"

struct Size {
    uint32_t width = 0;
    uint32_t height = 0;

    bool operator==(const Size& other) const { return width == other.width && height == other.height; }
};

/// Renders one scene. Failures are exceptions, as Device's.
class ProgressiveView {
public:
    /// Refines up to `samples` a pixel.
    ProgressiveView(Device& device, minirt_scene* scene, uint32_t samples) : device_(device), scene_(scene), samples_(samples) {}
    ~ProgressiveView() { minirt_end(job_); }
    ProgressiveView(const ProgressiveView&) = delete;
    ProgressiveView& operator=(const ProgressiveView&) = delete;

    /// Drops what was there and renders one sample, at a resolution that takes about kPreviewMs.
    void preview(const minirt_camera& camera, Size size);
    /// One short dispatch at full resolution, from the camera and size of the last preview. Nothing once finished().
    void refine();

    bool finished() const { return samplesDone_ == samples_; }
    /// Complete samples at full resolution.
    uint32_t samplesDone() const { return samplesDone_; }
    double msPerSample() const { return msPerSample_; }

    /// The best there is: the preview's size or the full one. Where full pixels are still missing the preview shines through.
    const Picture& picture();

private:
    static constexpr double kPreviewMs = 40;
    static constexpr float kStepMs = 30;

    void begin();
    void composeFromJob();

    Device& device_;
    minirt_scene* scene_;
    uint32_t samples_;
    minirt_job* job_ = nullptr;  // at full resolution, null while there is only a preview
    minirt_camera camera_ = {};
    Size size_;
    Picture preview_;
    Picture picture_;
    uint32_t samplesDone_ = 0;
    double refineMs_ = 0;
    double msPerSample_ = 0;
    double pixelsPerMs_ = 0;  // 0: not measured yet
};
