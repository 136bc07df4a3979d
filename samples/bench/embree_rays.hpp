// The same rays through Embree, on all cores.
#pragma once
#include <memory>
#include <vector>

#include "../common/embree_scene.hpp"
#include "ray_sets.hpp"

namespace bench {

class EmbreeRays {
public:
    enum class Packing { single, eight };

    /// Only where EmbreeScene::available().
    EmbreeRays(const Triangles& mesh, EmbreeScene::Mode mode);
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
