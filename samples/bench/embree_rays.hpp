// The same rays through Embree, on all cores.
#pragma once
#include <memory>
#include <vector>

#include "ray_sets.hpp"

namespace bench {

class EmbreeRays {
public:
    enum class Mode { robust, fast };  // RTC_SCENE_FLAG_ROBUST or Embree's default
    enum class Packing { single, eight };

    /// False where minirt was built without Embree: then nothing else may be called.
    static bool available();

    /// Builds at medium quality, Embree's default.
    EmbreeRays(const Triangles& mesh, Mode mode);
    ~EmbreeRays();
    EmbreeRays(const EmbreeRays&) = delete;
    EmbreeRays& operator=(const EmbreeRays&) = delete;

    /// Of the rays of all later calls.
    void setRays(const std::vector<Ray>& rays, bool coherent);
    /// Milliseconds by the wall's clock.
    double trace(bool anyHit, Packing packing);
    /// Of the last trace.
    const std::vector<Hit>& hits() const;

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

}  // namespace bench
