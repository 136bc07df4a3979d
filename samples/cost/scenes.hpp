// The scene as each configuration wants it, ready to render.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "../common/device.hpp"
#include "render_levers.hpp"

namespace cost {

/// A blob on the device for one integrator: pipelines stay when others render in between.
struct LoadedScene {
    minirt_scene* scene = nullptr;
    size_t kernelBytes = 0;
};

/// Loads blobs when a configuration first asks for them, and unloads them with itself; the device must live longer.
class Scenes {
public:
    /// `blobOf` gives the blob's path of a configuration and may bake it.
    using BlobOf = std::function<std::string(const Configuration&)>;

    Scenes(Device& device, std::vector<Lever> levers, BlobOf blobOf)
        : device_(device), levers_(std::move(levers)), blobOf_(std::move(blobOf)) {}
    ~Scenes();
    Scenes(const Scenes&) = delete;
    Scenes& operator=(const Scenes&) = delete;

    /// Throws std::runtime_error where it cannot be baked or loaded.
    const LoadedScene& load(const Configuration& configuration);

    Device& device() { return device_; }
    const std::vector<Lever>& levers() const { return levers_; }
    /// Takes the table's place: as many levers in the same order, those of the bake unchanged.
    void setLevers(std::vector<Lever> levers) { levers_ = std::move(levers); }

private:
    Device& device_;
    std::vector<Lever> levers_;
    BlobOf blobOf_;
    std::map<std::pair<std::string, minirt_integrator>, LoadedScene> loaded_;
};

}  // namespace cost
