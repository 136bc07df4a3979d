#include "scenes.hpp"

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace cost {
namespace {

/// A picture of one pixel, which brings the pipelines with it.
void makePipelines(const std::string& blob, minirt_integrator integrator, Device& device, LoadedScene& loaded) {
    minirt_render_desc desc = {};
    minirt_stats stats = {};
    float pixel[4];
    desc.width = desc.height = desc.samples = 1;
    desc.max_depth = 1;
    desc.integrator = integrator;
    desc.stats = &stats;
    try {
        loaded.device = &device;
        loaded.kernelBytes = kernelBytes(blob, integrator);
        loaded.scene = device.load(blob);
        device.require(minirt_render(loaded.scene, &desc, pixel), "");
        loaded.pipelineMs = stats.pipeline_ms;
    } catch (const std::exception& error) {
        loaded.failure = error.what();
    }
}

}  // namespace

size_t mostDevices() {
    return std::clamp(std::thread::hardware_concurrency(), 1u, 4u);
}

Scenes::~Scenes() {
    for (const auto& [key, loaded] : loaded_) minirt_unload(loaded.scene);
}

Device& Scenes::device(size_t number) {
    while (others_.size() < number) others_.push_back(first_.another());
    return number == 0 ? first_ : *others_[number - 1];
}

std::vector<Scenes::Key> Scenes::keysOf(const std::vector<Configuration>& configurations) const {
    const std::vector<std::string> blobs = blobsOf_(levers_, configurations);
    std::vector<Key> keys;
    for (size_t i = 0; i < blobs.size(); ++i) keys.emplace_back(blobs[i], renderDesc(levers_, configurations[i]).integrator);
    return keys;
}

void Scenes::prepare(const std::vector<Configuration>& configurations) {
    std::vector<std::pair<const Key*, LoadedScene*>> fresh;
    for (Key& key : keysOf(configurations)) {
        const auto [slot, isNew] = loaded_.try_emplace(std::move(key));
        if (isNew) fresh.push_back({&slot->first, &slot->second});
    }
    std::vector<std::thread> threads;
    const size_t devices = std::min(fresh.size(), mostDevices());
    for (size_t d = 0; d < devices; ++d) device(d);  // which may throw, before a thread runs
    for (size_t d = 0; d < devices; ++d)
        threads.emplace_back([&fresh, &on = device(d), d, devices] {
            for (size_t i = d; i < fresh.size(); i += devices)
                makePipelines(fresh[i].first->first, fresh[i].first->second, on, *fresh[i].second);
        });
    for (std::thread& thread : threads) thread.join();
}

const LoadedScene& Scenes::at(const Configuration& configuration) {
    const Key key = keysOf({configuration}).front();
    if (loaded_.find(key) == loaded_.end()) prepare({configuration});
    return loaded_.at(key);
}

const LoadedScene& Scenes::load(const Configuration& configuration) {
    const LoadedScene& loaded = at(configuration);
    if (!loaded.failure.empty()) throw std::runtime_error(loaded.failure);
    return loaded;
}

bool Scenes::share(const Configuration& a, const Configuration& b) {
    return &at(a) == &at(b);
}

}  // namespace cost
