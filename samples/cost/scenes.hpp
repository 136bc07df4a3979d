// The scene as each configuration wants it, ready to render.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "../common/device.hpp"
#include "render_levers.hpp"

namespace cost {

/// How many devices make pipelines side by side: each takes a core, and memory for its scenes.
size_t mostDevices();

/// A blob on a device for one integrator: pipelines stay when others render in between.
struct LoadedScene {
    const Device* device = nullptr;
    minirt_scene* scene = nullptr;
    size_t kernelBytes = 0;
    double pipelineMs = 0;  // creation of the pipelines and an empty first dispatch, beside those of other scenes
    std::string failure;    // why it cannot be rendered, or ""
};

/// Loads blobs and makes their pipelines when a configuration first asks for them, and unloads them with itself; `first` must live longer. Of several at once
/// pipelines are made side by side, each of these on a device of its own, since a device does one thing at a time.
class Scenes {
public:
    /// Gives the paths of the configurations' blobs, and may bake them.
    using BlobsOf = std::function<std::vector<std::string>(const std::vector<Lever>&, const std::vector<Configuration>&)>;

    Scenes(Device& first, std::vector<Lever> levers, BlobsOf blobsOf)
        : first_(first), levers_(std::move(levers)), blobsOf_(std::move(blobsOf)) {}
    ~Scenes();
    Scenes(const Scenes&) = delete;
    Scenes& operator=(const Scenes&) = delete;

    /// Makes ready what of these is not. Throws std::runtime_error where one cannot be baked or loaded.
    void prepare(const std::vector<Configuration>& configurations);

    /// Throws std::runtime_error where it cannot be baked, loaded or rendered.
    const LoadedScene& load(const Configuration& configuration);

    /// Whether two configurations are rendered by the same kernels from the same data. Throws as load does.
    bool share(const Configuration& a, const Configuration& b);

    /// How many were made ready.
    size_t count() const { return loaded_.size(); }

    bool onCpu() const { return first_.info().is_cpu != 0; }
    const std::vector<Lever>& levers() const { return levers_; }
    /// Takes the table's place: as many levers in the same order, those of the bake unchanged.
    void setLevers(std::vector<Lever> levers) { levers_ = std::move(levers); }

private:
    using Key = std::pair<std::string, minirt_integrator>;

    std::vector<Key> keysOf(const std::vector<Configuration>& configurations) const;
    const LoadedScene& at(const Configuration& configuration);
    Device& device(size_t number);

    Device& first_;
    std::vector<std::unique_ptr<Device>> others_;
    std::vector<Lever> levers_;
    BlobsOf blobsOf_;
    std::map<Key, LoadedScene> loaded_;
};

}  // namespace cost
