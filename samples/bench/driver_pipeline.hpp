// The same rays through the ray tracing pipeline of the Vulkan driver, on a device of its own.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "ray_sets.hpp"

namespace bench {

class DriverPipeline {
public:
    /// On the device of that name. Null where it offers no such pipeline, with the reason in `whyNot`. Throws std::runtime_error where a
    /// device that offers it fails.
    static std::unique_ptr<DriverPipeline> open(const std::string& deviceName, std::string& whyNot);
    ~DriverPipeline();
    DriverPipeline(const DriverPipeline&) = delete;
    DriverPipeline& operator=(const DriverPipeline&) = delete;

    /// Builds the structures for fast tracing.
    void setMesh(const Triangles& mesh);
    /// Of the last mesh: milliseconds by the device's clock, bytes of the finished structures.
    double buildMs() const;
    uint64_t structureBytes() const;

    void setRays(const std::vector<Ray>& rays);
    /// Milliseconds by the device's clock.
    double trace(bool anyHit);
    /// Of the last trace. Distances, and primitives only as far as kNoHit is told from the others.
    std::vector<Hit> hits();

private:
    struct Insides;
    explicit DriverPipeline(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

}  // namespace bench
