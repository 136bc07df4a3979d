#include "ray_query.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "runtime_hooks.hpp"

// The insides of the runtime are used here. The program's copy of it is this one: linked first, it leaves the compiler's aside.
#define MINIRT_IMPLEMENTATION
#include "minirt.h"

namespace test {

namespace detail = minirt_detail;

namespace {

constexpr uint32_t kRowRays = 8;          // of the image that the kernel takes the rays for
constexpr uint32_t kMaxGroups = 1 << 12;  // of a dispatch

struct DeviceHit {
    float t;
    uint32_t slot;
};

static_assert(sizeof(oracle::Ray) == 32 && sizeof(DeviceHit) == 8, "the layout that the kernel reads and writes");

std::vector<uint8_t> blobOf(const minirtc::Scene& scene, const minirtc::Geometry& geometry, const minirtc::Bvh& bvh,
                            minirtc::LayoutChoice layout) {
    const minirtc::EncodedNodes nodes = minirtc::encodeNodes(bvh, geometry, layout);
    minirtc::Diagnostics diagnostics;
    const minirtc::Volumes volumes = minirtc::analyseVolumes(scene, geometry, diagnostics);
    const minirtc::EffectSet effects =
        minirtc::analyseEffects(scene, geometry, volumes, nodes.layout == MINIRT_NODES_FLOAT, false);
    return minirtc::assembleBlob({scene, geometry, bvh, nodes, volumes, effects, {minirtc::compileKernel("rays", effects)}});
}

/// As the device reads them: whole groups, the ends finite.
std::vector<oracle::Ray> padded(const std::vector<oracle::Ray>& rays) {
    std::vector<oracle::Ray> all = rays;
    const oracle::Ray idle = {glm::vec3(0), 0, glm::vec3(0, 0, 1), 0};
    all.resize((rays.size() + detail::kBlockPixels - 1) / detail::kBlockPixels * detail::kBlockPixels, idle);
    for (oracle::Ray& ray : all) ray.tMax = std::min(ray.tMax, MINIRT_RAY_END);
    return all;
}

}  // namespace

struct RayQuery::Device {
    minirt_context* context = nullptr;
    minirt_scene* scene = nullptr;
    std::vector<uint32_t> order;  // slot -> primitive
    QueryStats stats;

    ~Device() { minirt_unload(scene); }

    void require(minirt_result result) const {
        if (result) throw std::runtime_error(std::string("ray query: ") + minirt_last_message(context));
    }

    void upload(const std::vector<oracle::Ray>& rays) {
        const uint64_t slots = std::min<uint64_t>(rays.size(), uint64_t{kMaxGroups} * detail::kBlockPixels);
        constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        require(detail::ensureBuffer(scene, MINIRT_BINDING_FILM, rays.size() * sizeof(oracle::Ray), usage));
        require(detail::ensureBuffer(scene, MINIRT_BINDING_RAY_COUNTS, rays.size() * sizeof(DeviceHit), usage));
        require(detail::ensureBuffer(scene, MINIRT_BINDING_STATE, slots * stateWords() * sizeof(uint32_t), 0));
        detail::writeDescriptors(scene);
        const detail::Buffer& target = scene->buffers[MINIRT_BINDING_FILM];
        const size_t size = rays.size() * sizeof(oracle::Ray);
        if (target.mapped) {
            std::memcpy(target.mapped, rays.data(), size);
            return;
        }
        detail::Buffer staging;
        const minirt_result result = detail::uploadThroughStaging(context, target, rays.data(), size, staging);
        detail::destroyBuffer(context, staging);
        require(result);
    }

    /// Words of saved state a ray, as shaders/kernels/rays.comp lays them out.
    uint32_t stateWords() const { return 1 + MINIRT_TRAVERSAL_WORDS + scene->desc.bvh_depth; }

    /// All rays, in as many dispatches as it takes.
    void run(uint32_t groups, QueryMode mode) {
        minirt_job job;
        job.scene = scene;
        job.frame.size = {kRowRays, groups * kRowRays, 0, 0};
        job.frame.region = {0, 0, kRowRays, groups * kRowRays};
        minirt_counters* counters = detail::hostCounters(scene);
        std::memset(counters, 0, sizeof *counters);
        for (uint32_t first = 0; first < groups; first += kMaxGroups) {
            const uint32_t count = std::min(kMaxGroups, groups - first);
            job.frame.blocks = {first, 1, 0, stateWords()};
            bool resume = false;
            do {
                job.frame.sampling = {0, mode == QueryMode::any ? 1u : 0u, 0, resume ? 1u : 0u};
                double ms = 0;
                require(detail::dispatch(&job, count, &ms));
                stats.gpuMs += ms;
                stats.dispatches++;
                stats.resumed += resume ? 1 : 0;
                resume = counters->pending > 0;
                counters->pending = 0;
            } while (resume);
        }
    }

    std::vector<QueryHit> readBack(size_t count) {
        const void* data = nullptr;
        require(detail::readBuffer(scene, MINIRT_BINDING_RAY_COUNTS, scene->countsReadBack, &data));
        std::vector<DeviceHit> found(count);
        std::memcpy(found.data(), data, count * sizeof(DeviceHit));
        std::vector<QueryHit> hits;
        hits.reserve(count);
        for (const DeviceHit& hit : found) hits.push_back({hit.t, hit.slot == MINIRT_NONE ? oracle::kNone : order.at(hit.slot)});
        return hits;
    }
};

RayQuery::RayQuery(minirt_context* context, const minirtc::Scene& scene, const minirtc::Geometry& geometry,
                   minirtc::LayoutChoice layout)
    : device_(new Device) {
    const minirtc::Bvh bvh = minirtc::buildBvh(geometry, 0);
    const std::vector<uint8_t> blob = blobOf(scene, geometry, bvh, layout);
    device_->context = context;
    device_->order = bvh.order;
    device_->require(minirt_load_memory(context, blob.data(), blob.size(), &device_->scene));
    const minirt_kernel* kernels[detail::kMostKernels] = {device_->scene->kernels};
    device_->require(detail::activateKernels(device_->scene, kernels));
}

RayQuery::~RayQuery() = default;
RayQuery::RayQuery(RayQuery&&) noexcept = default;

std::vector<QueryHit> RayQuery::trace(const std::vector<oracle::Ray>& rays, QueryMode mode) {
    device_->stats = {};
    if (rays.empty()) return {};
    const std::vector<oracle::Ray> all = padded(rays);
    device_->upload(all);
    device_->run(static_cast<uint32_t>(all.size() / detail::kBlockPixels), mode);
    return device_->readBack(rays.size());
}

const QueryStats& RayQuery::stats() const {
    return device_->stats;
}

uint32_t stepBudget(const minirt_context* context) {
    return context->stepBudget;
}

void setStepBudget(minirt_context* context, uint32_t steps) {
    context->stepBudget = steps;
}

void specialiseAsGpu(minirt_context* context) {
    context->info.is_cpu = 0;
}

void limitStorage(minirt_context* context, uint32_t bytes) {
    context->limits.maxStorageBufferRange = bytes;
}

bool fetchesTexels(const minirt_scene* scene) {
    return detail::specialisation(scene).fetchTexels != 0;
}

void limitAllocations(minirt_context* context, int count) {
    static PFN_vkAllocateMemory allocate;
    static int left;
    allocate = context->vk.AllocateMemory;
    left = count;
    context->vk.AllocateMemory = [](VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                                    VkDeviceMemory* memory) {
        return left-- > 0 ? allocate(device, info, callbacks, memory) : VK_ERROR_OUT_OF_DEVICE_MEMORY;
    };
}

void denyBallots(minirt_context* context) {
    context->hasBallots = context->canShareTrees = false;
}

void allowSharedTrees(minirt_context* context) {
    context->canShareTrees = true;
}

void limitTexels(minirt_context* context, uint32_t texels) {
    context->limits.maxTexelBufferElements = texels;
}

void takeFloat64(minirt_context* context) {
    context->float64 = false;
}

void loseDevice(minirt_context* context) {
    context->lost = true;
}

void breakValidation(minirt_context* context) {
    VkFenceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    info.flags = 1u << 20;  // no such flag
    VkFence fence = VK_NULL_HANDLE;
    if (context->vk.CreateFence(context->device, &info, nullptr, &fence) == VK_SUCCESS)
        context->vk.DestroyFence(context->device, fence, nullptr);
}

}  // namespace test
