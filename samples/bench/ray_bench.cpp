#include "ray_bench.hpp"

#include <algorithm>

#include "../common/wake.hpp"
#include "embree_rays.hpp"

namespace bench {
namespace {

/// Of distances, in radii of the mesh: that of rays which graze a triangle is rounded most.
constexpr float kTolerance = 1e-4f;

struct RaySet {
    const char* name;
    std::vector<Ray> rays;
    bool anyHit;
    bool coherent;
};

Spread mraysPerSecond(size_t rays, const std::vector<double>& ms) {
    std::vector<double> rates;
    rates.reserve(ms.size());
    for (double one : ms) rates.push_back(static_cast<double>(rays) / one * 1e-3);
    return spreadOf(rates);
}

Spread nsPerRay(size_t rays, const std::vector<double>& ms) {
    std::vector<double> costs;
    costs.reserve(ms.size());
    for (double one : ms) costs.push_back(one * 1e6 / static_cast<double>(rays));
    return spreadOf(costs);
}

/// What the last of some runs says that keep a GPU busy for a moment: it waits while the other's turn is set up.
template <typename Run>
double awake(const Run& run) {
    constexpr double kTurnMs = 30;
    return runFor(kTurnMs, run);
}

/// All that trace one mesh.
class Field {
public:
    Field(const Mesh& mesh, RayKernel& kernel, RayKernel* counting, DriverPipeline* pipeline, const RayBenchOptions& options)
        : kernel_(kernel),
          counting_(counting),
          pipeline_(pipeline),
          rounds_(options.rounds),
          tolerance_(kTolerance * surroundingsOf(mesh.triangles).radius) {
        if (pipeline_) pipeline_->setMesh(mesh.triangles);
        if (!EmbreeScene::available() || options.alone) return;
        robust_ = std::make_unique<EmbreeRays>(mesh.triangles, EmbreeScene::Mode::robust);
        fast_ = std::make_unique<EmbreeRays>(mesh.triangles, EmbreeScene::Mode::fast);
    }

    RaySetResult trace(const RaySet& set) {
        setRays(set);
        std::vector<Contender> contenders;
        std::vector<Times> times;
        if (kernel_.isGpu()) runFor(kWakeMs, [&] { return kernel_.trace(set.anyHit); });
        for (const std::vector<Contender>& together : heats(set.anyHit)) {
            const std::vector<Times> taken = takeTurns(together, rounds_);
            contenders.insert(contenders.end(), together.begin(), together.end());
            times.insert(times.end(), taken.begin(), taken.end());
        }
        RaySetResult result{set.name, set.rays.size(), 0, {}};
        for (size_t i = 0; i < contenders.size(); ++i)
            result.contenders.push_back({contenders[i].name,
                                         mraysPerSecond(set.rays.size(), times[i].ms),
                                         nsPerRay(set.rays.size(), times[i].processorMs),
                                         ratioTo(times[i].ms, times[0].ms),
                                         ratioTo(times[i].processorMs, times[0].processorMs),
                                         {}});
        const std::vector<Hit> own = kernel_.hits();
        result.hits = agreement(own, own, true, 0).hits;
        judge(set.anyHit, own, result);
        if (counting_) result.profile = profileOf(set, own, result.contenders.front());
        return result;
    }

private:
    void setRays(const RaySet& set) {
        kernel_.setRays(set.rays);
        if (pipeline_) pipeline_->setRays(set.rays);
        for (EmbreeRays* embree : {robust_.get(), fast_.get()})
            if (embree) embree->setRays(set.rays, set.coherent);
    }

    /// Who takes turns with whom. Embree stands back from a GPU: one that waits for it lowers its clock, and whoever comes first then runs at
    /// a lower one than the next.
    std::vector<std::vector<Contender>> heats(bool anyHit) {
        const std::vector<Contender> device = deviceContenders(anyHit);
        std::vector<Contender> processor = processorContenders(anyHit);
        if (kernel_.isGpu()) return {device, processor};
        processor.insert(processor.begin(), device.begin(), device.end());
        return {processor};
    }

    std::vector<Contender> deviceContenders(bool anyHit) {
        std::vector<Contender> contenders = {{"minirt", [this, anyHit] {
                                                  return kernel_.isGpu() ? awake([&] { return kernel_.trace(anyHit); })
                                                                         : kernel_.trace(anyHit);
                                              }}};
        if (pipeline_)
            contenders.push_back({kPipeline, [this, anyHit] { return awake([&] { return pipeline_->trace(anyHit); }); }});
        return contenders;
    }

    std::vector<Contender> processorContenders(bool anyHit) {
        using Packing = EmbreeRays::Packing;
        if (!robust_) return {};
        return {{kRobust, [this, anyHit] { return robust_->trace(anyHit, Packing::single); }},
                {kFast, [this, anyHit] { return fast_->trace(anyHit, Packing::single); }},
                {"Embree, packets of 8", [this, anyHit] { return fast_->trace(anyHit, Packing::eight); }}};
    }

    /// Only what is as exact as minirt must agree; the driver's pipeline is counted for the reader.
    void judge(bool anyHit, const std::vector<Hit>& own, RaySetResult& result) {
        for (ContenderResult& contender : result.contenders) {
            if (contender.name == kPipeline) contender.agreement = agreement(own, pipeline_->hits(), anyHit, tolerance_);
            contender.mustAgree = contender.name == kRobust;
            if (contender.mustAgree) contender.agreement = agreement(own, robust_->hits(), anyHit, tolerance_);
        }
    }

    RayProfile profileOf(const RaySet& set, const std::vector<Hit>& own, const ContenderResult& timed) {
        counting_->setRays(set.rays);
        counting_->trace(set.anyHit);
        RayProfile profile = bench::profileOf(counting_->work(), set.rays.size(), kernel_.nodeBytes(), kernel_.primitiveBytes());
        profile.ns = kernel_.isGpu() ? 1e3 / timed.mraysPerSecond.median : timed.processorNs.median;
        profile.hits = agreement(own, counting_->hits(), set.anyHit, tolerance_);
        return profile;
    }

    static constexpr const char* kPipeline = "driver's pipeline";
    static constexpr const char* kRobust = "Embree robust";
    static constexpr const char* kFast = "Embree";

    RayKernel& kernel_;
    RayKernel* counting_;
    DriverPipeline* pipeline_;
    int rounds_;
    float tolerance_;
    std::unique_ptr<EmbreeRays> robust_, fast_;
};

}  // namespace

bool RaySetResult::agrees() const {
    if (profile && !profile->hits.good()) return false;
    return std::all_of(contenders.begin(), contenders.end(),
                       [](const ContenderResult& c) { return !c.mustAgree || c.agreement->good(); });
}

std::vector<RaySetResult> benchRays(const Mesh& mesh, RayKernel& kernel, RayKernel* counting, DriverPipeline* pipeline,
                                    const RayBenchOptions& options) {
    Field field(mesh, kernel, counting, pipeline, options);
    RaySet primary{"primary", primaryRays(surroundingsOf(mesh.triangles), options.width, options.height), false, true};
    std::vector<RaySetResult> results = {field.trace(primary)};
    SecondaryRays secondary = secondaryRays(mesh.triangles, primary.rays, kernel.hits(), options.perHit, options.seed);
    if (secondary.diffuse.empty()) return results;
    std::vector<Ray> disordered = shuffled(secondary.diffuse, options.seed);
    results.push_back(field.trace({"shadow", std::move(secondary.shadow), true, true}));
    results.push_back(field.trace({"diffuse", std::move(secondary.diffuse), false, false}));
    results.push_back(field.trace({"shuffled", std::move(disordered), false, false}));
    return results;
}

}  // namespace bench
