#include "ray_kernel.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "device_copy.hpp"
#include "timing.hpp"

// The insides of the runtime are used here. The program's copy of it is this one: linked first, it leaves the compiler's aside.
#define MINIRT_IMPLEMENTATION
#include "minirt.h"

namespace bench {

namespace detail = minirt_detail;

namespace {

constexpr uint32_t kRowRays = 8;  // of the image that the kernel takes the rays for
constexpr uint32_t kPrimitiveBytes = MINIRT_PRIMITIVE_ROWS * sizeof(minirt_vec4);
constexpr uint64_t kMostStateBytes = 1ull << 30;  // of rays whose budget of steps is spent

struct DeviceHit {
    float t;
    uint32_t slot;
};

static_assert(sizeof(Ray) == 32 && sizeof(DeviceHit) == 8 && sizeof(RayWork) == 32,
              "the layout that the kernel reads and writes");

/// A blob with kernels for rays alone.
struct RayBlob {
    std::vector<uint8_t> bytes;
    uint64_t sceneBytes = 0;  // of the hierarchy and the primitives

    RayBlob(const RayScene& in, bool counting, const std::vector<std::string>& kernels) {
        const minirtc::EncodedNodes nodes = minirtc::encodeNodes(in.bvh, in.geometry, in.layout);
        minirtc::Diagnostics diagnostics;
        const minirtc::Volumes volumes = minirtc::analyseVolumes(in.scene, in.geometry, diagnostics);
        minirtc::EffectSet effects =
            minirtc::analyseEffects(in.scene, in.geometry, volumes, nodes.layout == MINIRT_NODES_FLOAT, false);
        effects.profile = counting;
        std::vector<minirtc::Kernel> compiled;
        compiled.reserve(kernels.size());
        for (const std::string& name : kernels) compiled.push_back(minirtc::compileKernel(name, effects));
        bytes = minirtc::assembleBlob({in.scene, in.geometry, in.bvh, nodes, volumes, effects, compiled});
        sceneBytes = nodes.words.size() * sizeof(uint32_t) + in.bvh.order.size() * kPrimitiveBytes;
    }
};

}  // namespace

struct RayKernel::Insides {
    minirt_context* context = nullptr;
    minirt_scene* scene = nullptr;
    bool counting = false;
    std::vector<uint32_t> order;  // slot -> primitive
    SceneBytes bytes;
    detail::Buffer workReadBack;
    size_t rayCount = 0;
    uint32_t groups = 0;
    uint32_t groupsAtOnce = 0;

    Insides(minirt_context* on, const RayBlob& blob) : context(on) {
        require(minirt_load_memory(context, blob.bytes.data(), blob.bytes.size(), &scene));
        const minirt_kernel* kernels[detail::kMostKernels] = {};
        for (uint32_t i = 0; i < scene->kernelCount; ++i) kernels[i] = &scene->kernels[i];
        require(detail::activateKernels(scene, kernels));
    }
    ~Insides() {
        detail::destroyBuffer(context, workReadBack);
        minirt_unload(scene);
    }
    Insides(const Insides&) = delete;
    Insides& operator=(const Insides&) = delete;

    void require(minirt_result result) const {
        if (result) throw std::runtime_error(std::string("rays on the device: ") + minirt_last_message(context));
    }

    /// Words of saved state a ray, as shaders/kernels/rays.comp lays them out.
    uint32_t stateWords() const { return 1 + MINIRT_TRAVERSAL_WORDS + scene->desc.bvh_depth; }

    void allocate() {
        const uint64_t groupBytes = uint64_t{stateWords()} * detail::kBlockPixels * sizeof(uint32_t);
        const uint64_t most = std::min<uint64_t>(kMostStateBytes, context->limits.maxStorageBufferRange) / groupBytes;
        groupsAtOnce = static_cast<uint32_t>(std::min<uint64_t>({most, groups, context->limits.maxComputeWorkGroupCount[0]}));
        const uint64_t rays = uint64_t{groups} * detail::kBlockPixels;
        if (rays * sizeof(Ray) > context->limits.maxStorageBufferRange)
            throw std::runtime_error("rays on the device: too many for a buffer; fewer pixels or rays per hit help");
        constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        require(detail::ensureBuffer(scene, MINIRT_BINDING_FILM, rays * sizeof(Ray), usage));
        require(detail::ensureBuffer(scene, MINIRT_BINDING_RAY_COUNTS, rays * sizeof(DeviceHit), usage));
        require(detail::ensureBuffer(scene, MINIRT_BINDING_STATE, groupsAtOnce * groupBytes, 0));
        if (counting) require(detail::ensureBuffer(scene, MINIRT_BINDING_QUEUES, rays * sizeof(RayWork), usage));
        detail::writeDescriptors(scene);
    }

    /// The kernel reads texels where the device is a CPU.
    void uploadTexels(const std::vector<Ray>& rays) {
        if (!context->info.is_cpu) return;
        detail::Buffer staging;
        detail::destroyBuffer(context, scene->buffers[MINIRT_BINDING_ENVIRONMENT]);
        const minirt_result result =
            detail::uploadPart(scene, MINIRT_BINDING_ENVIRONMENT, rays.data(), rays.size() * sizeof(Ray), staging);
        detail::destroyBuffer(context, staging);
        require(result);
    }

    void upload(const std::vector<Ray>& rays) {
        const detail::Buffer& target = scene->buffers[MINIRT_BINDING_FILM];
        const size_t size = rays.size() * sizeof(Ray);
        if (target.mapped) {
            std::memcpy(target.mapped, rays.data(), size);
            return;
        }
        detail::Buffer staging;
        const minirt_result result = detail::uploadThroughStaging(context, target, rays.data(), size, staging);
        detail::destroyBuffer(context, staging);
        require(result);
    }

    double dispatch(minirt_job& job, uint32_t count, bool resume) {
        job.frame.sampling.w = resume ? 1u : 0u;
        double ms = 0;
        require(detail::dispatch(&job, count, &ms));
        return ms;
    }

    bool takePending() {
        minirt_counters* counters = detail::hostCounters(scene);
        const bool pending = counters->pending > 0;
        std::memset(counters, 0, sizeof *counters);
        return pending;
    }

    /// The kernel that can go on with what is left of a ray, from the start: some ray's budget did not last.
    double traceAgain(minirt_job& job, uint32_t count) {
        std::swap(scene->pipelines[0], scene->pipelines[1]);
        double ms = dispatch(job, count, false);
        while (takePending()) ms += dispatch(job, count, true);
        std::swap(scene->pipelines[0], scene->pipelines[1]);
        return ms;
    }

    /// All rays, in as many dispatches as it takes. Returns the sum of their durations.
    double run(bool anyHit) {
        minirt_job job;
        job.scene = scene;
        job.frame.size = {kRowRays, groups * kRowRays, 0, 0};
        job.frame.region = {0, 0, kRowRays, groups * kRowRays};
        job.frame.sampling = {0, anyHit ? 1u : 0u, 0, 0};
        double ms = 0;
        for (uint32_t first = 0; first < groups; first += groupsAtOnce) {
            const uint32_t count = std::min(groupsAtOnce, groups - first);
            job.frame.blocks = {first, 1, 0, stateWords()};
            ms += dispatch(job, count, false);
            if (takePending()) ms += traceAgain(job, count);
        }
        return ms;
    }
};

RayKernel::RayKernel(minirt_context* context, const RayScene& scene, Counting counting) {
    const bool counts = counting == Counting::on;
    if (counts && !context->hasBallots) throw std::runtime_error("counting needs subgroup ballots, which this device lacks");
    const RayBlob blob(scene, counts, {"rays_once", "rays"});
    insides_ = std::make_unique<Insides>(context, blob);
    insides_->counting = counts;
    insides_->order = scene.bvh.order;
    const detail::Buffer* buffers = insides_->scene->buffers;
    insides_->bytes.blob = blob.sceneBytes;
    insides_->bytes.device = buffers[MINIRT_BINDING_NODES].size + buffers[MINIRT_BINDING_PRIMITIVES].size;
}

RayKernel::~RayKernel() = default;

void RayKernel::setRays(const std::vector<Ray>& rays) {
    std::vector<Ray> all = rays;  // whole groups
    all.resize((rays.size() + detail::kBlockPixels - 1) / detail::kBlockPixels * detail::kBlockPixels,
               {glm::vec3(0), 0, glm::vec3(0, 0, 1), 0});
    for (Ray& ray : all) ray.tMax = std::min(ray.tMax, MINIRT_RAY_END);
    insides_->rayCount = rays.size();
    insides_->groups = static_cast<uint32_t>(all.size() / detail::kBlockPixels);
    insides_->uploadTexels(all);
    insides_->allocate();
    insides_->upload(all);
}

double RayKernel::trace(bool anyHit) {
    const double start = nowMs();
    const double device = insides_->run(anyHit);
    return insides_->context->info.is_cpu ? nowMs() - start : device;
}

std::vector<Hit> RayKernel::hits() {
    const void* data = nullptr;
    minirt_scene* scene = insides_->scene;
    insides_->require(detail::readBuffer(scene, MINIRT_BINDING_RAY_COUNTS, scene->countsReadBack, &data));
    std::vector<DeviceHit> found(insides_->rayCount);
    std::memcpy(found.data(), data, found.size() * sizeof(DeviceHit));
    std::vector<Hit> hits;
    hits.reserve(found.size());
    for (const DeviceHit& hit : found) hits.push_back({hit.t, hit.slot == MINIRT_NONE ? kNoHit : insides_->order.at(hit.slot)});
    return hits;
}

std::vector<RayWork> RayKernel::work() {
    const void* data = nullptr;
    insides_->require(detail::readBuffer(insides_->scene, MINIRT_BINDING_QUEUES, insides_->workReadBack, &data));
    std::vector<RayWork> work(size_t{insides_->groups} * detail::kBlockPixels);
    std::memcpy(work.data(), data, work.size() * sizeof(RayWork));
    return work;
}

bool RayKernel::isGpu() const {
    return !insides_->context->info.is_cpu;
}

const char* RayKernel::layout() const {
    return insides_->scene->desc.node_layout == MINIRT_NODES_FLOAT ? "float" : "quantised";
}

SceneBytes RayKernel::bytes() const {
    return insides_->bytes;
}

uint32_t RayKernel::nodeBytes() const {
    const minirt_scene* scene = insides_->scene;
    return scene->desc.node_layout == MINIRT_NODES_FLOAT ? 64 : 32;
}

uint32_t RayKernel::primitiveBytes() const {
    return kPrimitiveBytes;
}

void RayKernel::makePipeline(minirt_context* context, const RayScene& scene) {
    const Insides pipeline(context, RayBlob(scene, false, {"rays_once"}));
}

struct DeviceCopy::Insides {
    minirt_context* context;
    detail::Buffer target, staging;

    ~Insides() {
        detail::destroyBuffer(context, staging);
        detail::destroyBuffer(context, target);
    }

    void require(minirt_result result) const {
        if (result) throw std::runtime_error(std::string("copying to the device: ") + minirt_last_message(context));
    }
};

DeviceCopy::DeviceCopy(minirt_context* context, size_t size) : insides_(new Insides{context, {}, {}}) {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    insides_->require(detail::createBuffer(context, size, usage, detail::Placement::device, insides_->target));
}

DeviceCopy::~DeviceCopy() = default;

void DeviceCopy::write(const void* data) {
    detail::Buffer& target = insides_->target;
    const size_t size = static_cast<size_t>(target.size);
    if (target.mapped)
        std::memcpy(target.mapped, data, size);
    else
        insides_->require(detail::uploadThroughStaging(insides_->context, target, data, size, insides_->staging));
}

}  // namespace bench
