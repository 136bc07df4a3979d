// The runtime's API, as an application uses and misuses it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include "host_device.hpp"
#include "render_scene.hpp"
#include "runtime_hooks.hpp"

using test::bakeScene;
using test::GpuContext;
using test::HostDevice;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

constexpr uint32_t kSize = 64;
constexpr uint32_t kBlocks = 64;

/// Mirrors, glass and shadows in 64 x 64 pixels.
const char* kScene = R"({
    "camera":{"position":[0,2,6],"target":[0,0.7,0],"vfov":35},"render":{"size":[64,64],"maxDepth":6},"background":{"color":[0.1,0.2,0.4]},
    "lights":[{"type":"point","position":[2,5,3],"intensity":[40,40,40]}],
    "materials":{"matt":{"model":"phong","color":[0.9,0.5,0.2]},"glass":{"model":"pbr","roughness":0,"transmission":1},
                 "mirror":{"model":"phong","diffuse":0.2,"reflect":0.7}},
    "objects":[{"rectangle":{"origin":[-20,0,-20],"u":[0,0,40],"v":[40,0,0]},"material":"matt"},
               {"sphere":{"center":[-1,1,0],"radius":1},"material":"glass"},
               {"sphere":{"center":[1.2,0.8,-0.5],"radius":0.8},"material":"mirror"}]})";

std::vector<char> readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Counts blocks of host memory and refuses one on request.
struct CountingAllocator {
    int allocated = 0;
    int outstanding = 0;
    int refused = -1;  // number of the allocation to refuse

    minirt_allocator desc() {
        return {[](void* self, size_t size) { return static_cast<CountingAllocator*>(self)->allocate(size); },
                [](void* self, void* memory) {
                    static_cast<CountingAllocator*>(self)->outstanding--;
                    std::free(memory);
                },
                this};
    }
    void* allocate(size_t size) {
        if (allocated++ == refused) return nullptr;
        outstanding++;
        void* memory = std::malloc(size);
        std::memset(memory, 0xa5, size);
        return memory;
    }
};

std::string deviceName(minirt_context* context) {
    minirt_device_info info;
    minirt_get_device_info(context, &info);
    return info.name;
}

struct ProgressLog {
    std::vector<minirt_progress> reports;
    size_t cancelAfter = std::numeric_limits<size_t>::max();

    static int report(void* self, const minirt_progress* progress) {
        ProgressLog& log = *static_cast<ProgressLog*>(self);
        log.reports.push_back(*progress);
        return log.reports.size() >= log.cancelAfter;
    }
};

}  // namespace

TEST_CASE("result strings are distinct") {
    std::set<std::string> strings;
    for (int i = MINIRT_OK; i <= MINIRT_CANCELLED; ++i) strings.insert(minirt_result_string(static_cast<minirt_result>(i)));
    CHECK(strings.size() == MINIRT_CANCELLED + 1);
    CHECK(strings.count(minirt_result_string(static_cast<minirt_result>(MINIRT_CANCELLED + 1))) == 0);
}

TEST_CASE("the validation layer would be heard") {
    GpuContext gpu;
    if (!gpu) return;
    CHECK(gpu.takeMessages().empty());
    test::breakValidation(gpu.get());
    if (gpu.takeMessages().empty()) return test::skip("needs VK_LAYER_KHRONOS_validation");
    CHECK(gpu.takeMessages().empty());
}

TEST_CASE("progress never falls and ends at one") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, kScene));
    ProgressLog log;
    minirt_render_desc desc = {};
    desc.samples = 3;
    desc.max_dispatch_ms = 1e-6f;
    desc.progress = ProgressLog::report;
    desc.progress_user = &log;
    const Picture picture = scene.render(desc);
    REQUIRE(log.reports.size() == picture.stats.dispatches);
    double fraction = 0;
    uint32_t samples = 0;
    for (size_t i = 0; i < log.reports.size(); ++i) {
        REQUIRE(log.reports[i].fraction >= fraction);
        REQUIRE(log.reports[i].samples_done >= samples);
        REQUIRE(log.reports[i].done == (i + 1 == log.reports.size()));
        fraction = log.reports[i].fraction;
        samples = log.reports[i].samples_done;
    }
    CHECK(fraction == 1.0);
    CHECK(samples == 3);
}

TEST_CASE("short dispatches are many and long ones few and the picture is the same") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, kScene));
    minirt_render_desc desc = {};
    desc.max_dispatch_ms = 1e-6f;
    const Picture first = scene.render(desc);  // the speed is not known yet
    const Picture many = scene.render(desc);
    CHECK(many.stats.dispatches == kBlocks);
    desc.max_dispatch_ms = 1e9f;
    const Picture few = scene.render(desc);
    CHECK(few.stats.dispatches == 1);
    CHECK(first == many);
    CHECK(many == few);
}

TEST_CASE("cancelling keeps what is done and the scene usable") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, kScene));
    const Picture whole = scene.render();
    ProgressLog log;
    log.cancelAfter = 10;
    minirt_stats stats;
    minirt_render_desc desc = {};
    desc.max_dispatch_ms = 1e-6f;
    desc.progress = ProgressLog::report;
    desc.progress_user = &log;
    desc.stats = &stats;
    std::vector<float> rgba(whole.rgba.size(), 7.0f);
    CHECK(minirt_render(scene.get(), &desc, rgba.data()) == MINIRT_CANCELLED);
    CHECK(log.reports.size() == 10);
    CHECK(stats.dispatches == 10);
    size_t done = 0;
    for (size_t i = 0; i < rgba.size(); i += 4) {
        REQUIRE((rgba[i + 3] == 0.0f || rgba[i + 3] == 1.0f));
        for (size_t k = 0; k < 3; ++k) REQUIRE(rgba[i + k] == (rgba[i + 3] == 1.0f ? whole.rgba[i + k] : 0.0f));
        done += rgba[i + 3] == 1.0f;
    }
    CHECK(done == 10 * 64);
    CHECK(scene.render() == whole);
}

TEST_CASE("steps show the picture grow") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, kScene));
    const Picture whole = scene.render();
    minirt_render_desc desc = {};
    desc.max_dispatch_ms = 1e-6f;
    minirt_job* job = nullptr;
    REQUIRE(minirt_begin(scene.get(), &desc, &job) == MINIRT_OK);
    std::vector<float> rgba(whole.rgba.size());
    minirt_progress progress = {};
    size_t before = 0;
    while (!progress.done) {
        REQUIRE(minirt_read(job, rgba.data()) == MINIRT_OK);
        size_t shown = 0;
        for (size_t i = 0; i < rgba.size(); i += 4) {
            if (rgba[i + 3] == 0.0f) continue;
            shown++;
            REQUIRE(std::memcmp(&rgba[i], &whole.rgba[i], 16) == 0);
        }
        CHECK(shown == before);
        before += 64;
        REQUIRE(minirt_step(job, &progress) == MINIRT_OK);
    }
    CHECK(before == kSize * kSize);
    REQUIRE(minirt_step(job, &progress) == MINIRT_OK);  // after the end it does nothing
    minirt_stats stats;
    REQUIRE(minirt_get_stats(job, &stats) == MINIRT_OK);
    CHECK(stats.dispatches == kBlocks);
    REQUIRE(minirt_read(job, rgba.data()) == MINIRT_OK);
    CHECK(rgba == whole.rgba);
    minirt_end(job);
}

TEST_CASE("a scene renders one job at a time") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, kScene)), other(gpu, bakeScene(dir, kScene));
    minirt_job* job = nullptr;
    minirt_job* second = nullptr;
    REQUIRE(minirt_begin(scene.get(), nullptr, &job) == MINIRT_OK);
    CHECK(minirt_begin(scene.get(), nullptr, &second) == MINIRT_ERROR_BUSY);
    CHECK(second == nullptr);
    std::vector<float> rgba(kSize * kSize * 4);
    CHECK(minirt_render(scene.get(), nullptr, rgba.data()) == MINIRT_ERROR_BUSY);
    CHECK(gpu.takeMessages().size() == 2);
    const Picture beside = other.render();
    minirt_progress progress = {};
    while (!progress.done) REQUIRE(minirt_step(job, &progress) == MINIRT_OK);
    REQUIRE(minirt_read(job, rgba.data()) == MINIRT_OK);
    CHECK(rgba == beside.rgba);
    minirt_end(job);
    CHECK(scene.render() == beside);
}

TEST_CASE("two contexts render side by side") {
    GpuContext a, b;
    if (!a || !b) return;
    TemporaryDir dir;
    const std::filesystem::path blob = bakeScene(dir, kScene);
    const LoadedScene sceneA(a, blob), sceneB(b, blob);
    minirt_render_desc desc = {};
    desc.max_dispatch_ms = 1e-6f;
    minirt_job *jobA, *jobB;
    REQUIRE(minirt_begin(sceneA.get(), &desc, &jobA) == MINIRT_OK);
    REQUIRE(minirt_begin(sceneB.get(), &desc, &jobB) == MINIRT_OK);
    minirt_progress progressA = {}, progressB = {};
    while (!progressA.done || !progressB.done) {
        REQUIRE(minirt_step(jobA, &progressA) == MINIRT_OK);
        REQUIRE(minirt_step(jobB, &progressB) == MINIRT_OK);
    }
    std::vector<float> rgbaA(kSize * kSize * 4), rgbaB(kSize * kSize * 4);
    REQUIRE(minirt_read(jobA, rgbaA.data()) == MINIRT_OK);
    REQUIRE(minirt_read(jobB, rgbaB.data()) == MINIRT_OK);
    CHECK(rgbaA == rgbaB);
    minirt_end(jobA);
    minirt_end(jobB);
}

TEST_CASE("a context takes its scenes and their jobs with it") {
    TemporaryDir dir;
    const std::filesystem::path blob = bakeScene(dir, kScene);
    CountingAllocator memory;
    std::vector<std::string> messages;
    minirt_context_desc desc = {};
    desc.allocator = memory.desc();
    desc.log = test::collectMessage;
    desc.log_user = &messages;
    desc.validation = 1;
    minirt_context* context = nullptr;
    const minirt_result created = minirt_create(&desc, &context);
    if (created == MINIRT_ERROR_NO_DEVICE || created == MINIRT_ERROR_NO_VULKAN) return test::skip("needs a Vulkan device");
    REQUIRE(created == MINIRT_OK);
    minirt_scene* scenes[3];
    for (minirt_scene*& scene : scenes) REQUIRE(minirt_load_file(context, blob.string().c_str(), &scene) == MINIRT_OK);
    minirt_job* job;
    REQUIRE(minirt_begin(scenes[0], nullptr, &job) == MINIRT_OK);
    REQUIRE(minirt_step(job, nullptr) == MINIRT_OK);
    REQUIRE(minirt_begin(scenes[1], nullptr, &job) == MINIRT_OK);
    minirt_unload(scenes[1]);  // with its job
    minirt_destroy(context);
    minirt_unload(nullptr);
    minirt_end(nullptr);
    minirt_destroy(nullptr);
    CHECK(memory.allocated > 5);
    CHECK(memory.outstanding == 0);
    for (const std::string& message : messages) CHECK_MESSAGE(message.empty(), message);
}

namespace {

/// Creates, loads and renders with memory in which one allocation may be refused.
minirt_result renderWith(CountingAllocator& memory, const void* blob, size_t size) {
    minirt_context_desc desc = {};
    desc.allocator = memory.desc();
    minirt_context* context = nullptr;
    minirt_scene* scene = nullptr;
    std::vector<float> rgba(kSize * kSize * 4);
    minirt_result result = minirt_create(&desc, &context);
    if (!result) result = minirt_load_memory(context, blob, size, &scene);
    if (!result) result = minirt_render(scene, nullptr, rgba.data());
    CHECK((scene != nullptr || result != MINIRT_OK));
    minirt_destroy(context);
    return result;
}

}  // namespace

TEST_CASE("each allocation that fails is reported and nothing leaks") {
    TemporaryDir dir;
    const std::filesystem::path blob = bakeScene(dir, kScene);
    const std::vector<char> bytes = readFile(blob);
    std::vector<char> unaligned(bytes.size() + 1);
    std::copy(bytes.begin(), bytes.end(), unaligned.begin() + 1);
    int refused = 0;
    for (bool complete = false; !complete; ++refused) {
        REQUIRE(refused < 100);
        CountingAllocator memory;
        memory.refused = refused;
        const minirt_result result = renderWith(memory, unaligned.data() + 1, bytes.size());
        if (result == MINIRT_ERROR_NO_DEVICE || result == MINIRT_ERROR_NO_VULKAN) return test::skip("needs a Vulkan device");
        complete = memory.allocated <= refused;
        CHECK(result == (complete ? MINIRT_OK : MINIRT_ERROR_OUT_OF_MEMORY));
        CHECK(memory.outstanding == 0);
    }
    CHECK(refused > 4);
}

TEST_CASE("a device without memory for the scene is reported and nothing leaks") {
    TemporaryDir dir;
    const std::filesystem::path blob = bakeScene(dir, kScene);
    int allowed = 0;
    for (bool complete = false; !complete; ++allowed) {
        REQUIRE(allowed < 100);
        GpuContext gpu;  // whose validation layer misses what is not released
        if (!gpu) return;
        test::limitAllocations(gpu.get(), allowed);
        minirt_scene* scene = nullptr;
        const minirt_result result = minirt_load_file(gpu.get(), blob.string().c_str(), &scene);
        complete = result == MINIRT_OK;
        CHECK((complete || result == MINIRT_ERROR_DEVICE_OUT_OF_MEMORY));
        CHECK((scene != nullptr) == complete);
        CHECK(gpu.takeMessages().empty() == complete);
        minirt_unload(scene);
    }
    CHECK(allowed > 4);
}

TEST_CASE("an allocator needs both of its callbacks") {
    CountingAllocator memory;
    minirt_context_desc desc = {};
    desc.allocator = memory.desc();
    desc.allocator.release = nullptr;
    minirt_context* context = nullptr;
    CHECK(minirt_create(&desc, &context) == MINIRT_ERROR_INVALID_ARGUMENT);
    CHECK(context == nullptr);
    CHECK(memory.allocated == 0);
}

TEST_CASE("devices are found by number and by a part of their name") {
    uint32_t count = 0;
    const minirt_result listed = minirt_list_devices(nullptr, nullptr, &count);
    if (listed != MINIRT_OK || count == 0) return test::skip("needs a Vulkan device");
    std::vector<minirt_device_info> infos(count);
    REQUIRE(minirt_list_devices(nullptr, infos.data(), &count) == MINIRT_OK);
    REQUIRE(count == infos.size());
    for (const char* name : {static_cast<const char*>(infos[0].name), "0", ""}) {
        minirt_context_desc desc = {};
        desc.device_name = name;
        minirt_context* context = nullptr;
        REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
        CHECK(deviceName(context) == infos[0].name);
        minirt_destroy(context);
    }
    for (const char* name : {"no such device", "99", "99999999999999999999"}) {
        minirt_context_desc desc = {};
        desc.device_name = name;
        minirt_context* context = nullptr;
        CHECK(minirt_create(&desc, &context) == MINIRT_ERROR_NO_DEVICE);
        CHECK(context == nullptr);
    }
}

TEST_CASE("wrong requests are refused with a message") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, bakeScene(dir, kScene));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refuses = [&](minirt_result expected, const auto& change) {
        minirt_camera camera = {{0, 2, 6}, {0, 0.7, 0}, {0, 1, 0}, 35, 0, 0};
        minirt_render_desc desc = {};
        desc.camera = &camera;
        change(desc, camera);
        minirt_job* job = nullptr;
        CHECK(minirt_begin(scene.get(), &desc, &job) == expected);
        CHECK(job == nullptr);
        CHECK(gpu.takeMessages().size() == 1);
        CHECK(std::strlen(minirt_last_message(gpu.get())) > 10);
    };
    using Desc = minirt_render_desc;
    using Camera = minirt_camera;
    const minirt_result invalid = MINIRT_ERROR_INVALID_ARGUMENT;
    refuses(invalid, [](Desc& d, Camera&) { d.width = 10; });
    refuses(invalid, [](Desc& d, Camera&) { d.width = 20000, d.height = 10; });
    refuses(invalid, [](Desc& d, Camera&) { d.max_depth = 257; });
    refuses(MINIRT_ERROR_NO_KERNEL, [](Desc& d, Camera&) { d.integrator = MINIRT_INTEGRATOR_PATH; });
    refuses(invalid, [](Desc& d, Camera&) { d.region = {60, 0, 5, 5}; });
    refuses(invalid, [](Desc& d, Camera&) { d.region = {0, 0xfffffff0u, 5, 0x20}; });
    refuses(invalid, [](Desc& d, Camera&) { d.region = {1, 1, 0, 0}; });
    refuses(invalid, [](Desc& d, Camera&) { d.first_sample = 0xffffffffu, d.samples = 2; });
    refuses(invalid, [](Desc&, Camera& c) { c.target[1] = 2, c.target[2] = 6; });
    refuses(invalid, [](Desc&, Camera& c) { c.up[1] = 0; });
    refuses(invalid, [](Desc&, Camera& c) { c.vfov = 0; });
    refuses(invalid, [](Desc&, Camera& c) { c.vfov = 180; });
    refuses(invalid, [&](Desc&, Camera& c) { c.vfov = nan; });
    refuses(invalid, [&](Desc&, Camera& c) { c.position[1] = nan; });
    refuses(invalid, [&](Desc&, Camera& c) { c.position[0] = 1e300; });

    float rgba[4];
    minirt_scene* out = nullptr;
    minirt_job* job = nullptr;
    CHECK(minirt_begin(nullptr, nullptr, &job) == invalid);
    CHECK(minirt_begin(scene.get(), nullptr, nullptr) == invalid);
    CHECK(minirt_render(nullptr, nullptr, rgba) == invalid);
    CHECK(minirt_render(scene.get(), nullptr, nullptr) == invalid);
    CHECK(minirt_step(nullptr, nullptr) == invalid);
    CHECK(minirt_read(nullptr, rgba) == invalid);
    CHECK(minirt_create(nullptr, nullptr) == invalid);
    CHECK(minirt_load_file(gpu.get(), nullptr, &out) == invalid);
    CHECK(minirt_load_memory(gpu.get(), nullptr, 0, &out) == invalid);
    CHECK(minirt_load_file(gpu.get(), (dir.path() / "absent.mrt").string().c_str(), &out) == MINIRT_ERROR_FILE);
    CHECK(minirt_load_file(gpu.get(), dir.path().string().c_str(), &out) == MINIRT_ERROR_FILE);
    CHECK(minirt_load_file(gpu.get(), dir.write("empty.mrt", "").string().c_str(), &out) == MINIRT_ERROR_NOT_A_BLOB);
    CHECK(out == nullptr);
    gpu.takeMessages();
    scene.render();
}

TEST_CASE("blobs load from any address and from a file alike") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const std::filesystem::path path = bakeScene(dir, kScene);
    const std::vector<char> bytes = readFile(path);
    const Picture expected = LoadedScene(gpu, path).render();
    for (const size_t shift : {size_t{0}, size_t{1}, size_t{7}, size_t{8}}) {
        std::vector<char> memory(bytes.size() + 32, 0x55);
        char* start = memory.data() + (16 - reinterpret_cast<uintptr_t>(memory.data()) % 16) + shift;
        std::copy(bytes.begin(), bytes.end(), start);
        minirt_scene* scene = nullptr;
        REQUIRE(minirt_load_memory(gpu.get(), start, bytes.size(), &scene) == MINIRT_OK);
        std::fill(memory.begin(), memory.end(), 0);  // the data may go away
        std::vector<float> rgba(expected.rgba.size());
        REQUIRE(minirt_render(scene, nullptr, rgba.data()) == MINIRT_OK);
        CHECK(rgba == expected.rgba);
        minirt_unload(scene);
    }
}

TEST_CASE("after the loss of the device every call says so") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const std::filesystem::path path = bakeScene(dir, kScene);
    const std::vector<char> bytes = readFile(path);
    const LoadedScene scene(gpu, path);
    minirt_job* job = nullptr;
    REQUIRE(minirt_begin(scene.get(), nullptr, &job) == MINIRT_OK);
    test::loseDevice(gpu.get());
    float rgba[4] = {};
    minirt_stats stats;
    minirt_scene* other = nullptr;
    minirt_job* otherJob = nullptr;
    const minirt_result lost = MINIRT_ERROR_DEVICE_LOST;
    CHECK(minirt_step(job, nullptr) == lost);
    CHECK(minirt_read(job, rgba) == lost);
    CHECK(minirt_get_stats(job, &stats) == lost);
    CHECK(minirt_begin(scene.get(), nullptr, &otherJob) == lost);
    CHECK(minirt_render(scene.get(), nullptr, rgba) == lost);
    CHECK(minirt_load_file(gpu.get(), path.string().c_str(), &other) == lost);
    CHECK(minirt_load_memory(gpu.get(), bytes.data(), bytes.size(), &other) == lost);
    CHECK((other == nullptr && otherJob == nullptr));
    minirt_end(job);
}

TEST_CASE("the GPU-assisted checks of the validation layer find nothing") {
    GpuContext gpu(2);
    if (!gpu) return;
    TemporaryDir dir;
    GpuContext plain;
    const std::filesystem::path blob = bakeScene(dir, kScene);
    CHECK(LoadedScene(gpu, blob).render() == LoadedScene(plain, blob).render());
}

TEST_CASE("recording into an image of the host equals rendering bit for bit") {
    HostDevice host;
    if (!host) return;
    TemporaryDir dir;
    minirt_context_desc desc = {};
    desc.host = host.desc();
    minirt_context* context = nullptr;
    REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
    minirt_scene* scene = nullptr;
    REQUIRE(minirt_load_file(context, bakeScene(dir, kScene).string().c_str(), &scene) == MINIRT_OK);
    const minirt_camera moved = {{3, 2, 5}, {0, 0.5, 0}, {0, 1, 0}, 50, 0, 0};
    const auto rendered = [&](uint32_t sample, const minirt_camera* camera) {
        std::vector<float> rgba(kSize * kSize * 4);
        minirt_render_desc render = {};
        render.first_sample = sample;
        render.samples = 1;
        render.camera = camera;
        REQUIRE(minirt_render(scene, &render, rgba.data()) == MINIRT_OK);
        return rgba;
    };
    const std::vector<float> expected[] = {rendered(0, nullptr), rendered(3, nullptr), rendered(0, &moved)};
    CHECK(expected[0] != expected[1]);
    minirt_job* job = nullptr;
    REQUIRE(minirt_begin(scene, nullptr, &job) == MINIRT_OK);
    const auto recorded = [&](uint32_t sample, const minirt_camera* camera) {
        return host.recordToImage(kSize, kSize, [&](VkCommandBuffer commands, VkImage image) {
            REQUIRE(minirt_record(job, commands, image, camera, sample, 0) == MINIRT_OK);
        });
    };
    CHECK(recorded(0, nullptr) == expected[0]);
    CHECK(recorded(3, nullptr) == expected[1]);
    CHECK(recorded(0, &moved) == expected[2]);
    minirt_stats stats;
    REQUIRE(minirt_get_stats(job, &stats) == MINIRT_OK);
    CHECK(stats.traversal_cap == 0);
    minirt_camera nowhere = moved;
    nowhere.vfov = 0;
    host.recordToImage(kSize, kSize, [&](VkCommandBuffer commands, VkImage image) {
        CHECK(minirt_record(job, commands, image, &nowhere, 0, 0) == MINIRT_ERROR_INVALID_ARGUMENT);
    });
    minirt_end(job);
    minirt_destroy(context);
}

TEST_CASE("recording with too few passes counts the pixels that are missing") {
    HostDevice host;
    if (!host) return;
    TemporaryDir dir;
    minirt_context_desc desc = {};
    desc.host = host.desc();
    minirt_context* context = nullptr;
    REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
    test::setStepBudget(context, 12);
    minirt_scene* scene = nullptr;
    REQUIRE(minirt_load_file(context, bakeScene(dir, kScene).string().c_str(), &scene) == MINIRT_OK);
    std::vector<float> expected(kSize * kSize * 4);
    REQUIRE(minirt_render(scene, nullptr, expected.data()) == MINIRT_OK);
    minirt_job* job = nullptr;
    REQUIRE(minirt_begin(scene, nullptr, &job) == MINIRT_OK);
    uint64_t missingBefore = kSize * kSize;
    for (const uint32_t passes : {1u, 4u, 500u}) {
        CAPTURE(passes);
        const std::vector<float> image = host.recordToImage(kSize, kSize, [&](VkCommandBuffer commands, VkImage target) {
            REQUIRE(minirt_record(job, commands, target, nullptr, 0, passes) == MINIRT_OK);
        });
        uint64_t missing = 0;
        for (size_t i = 0; i < image.size(); i += 4) {
            missing += image[i + 3] == 0.0f;
            if (image[i + 3] != 0.0f) REQUIRE(std::memcmp(&image[i], &expected[i], 16) == 0);
        }
        minirt_stats stats;
        REQUIRE(minirt_get_stats(job, &stats) == MINIRT_OK);
        CHECK(stats.traversal_cap == missing);
        CHECK(missing < missingBefore);
        missingBefore = missing;
    }
    CHECK(missingBefore == 0);
    minirt_end(job);
    minirt_destroy(context);
}

TEST_CASE("a host device comes whole or not at all") {
    HostDevice host;
    if (!host) return;
    minirt_context_desc desc = {};
    desc.host = host.desc();
    desc.host.queue = VK_NULL_HANDLE;
    minirt_context* context = nullptr;
    CHECK(minirt_create(&desc, &context) == MINIRT_ERROR_INVALID_ARGUMENT);
    desc.host = {};
    desc.host.get_instance_proc_addr = host.desc().get_instance_proc_addr;  // alone it is fine
    REQUIRE(minirt_create(&desc, &context) == MINIRT_OK);
    minirt_destroy(context);
}
