#include "scenes.hpp"

namespace cost {

Scenes::~Scenes() {
    for (const auto& [key, loaded] : loaded_) minirt_unload(loaded.scene);
}

const LoadedScene& Scenes::load(const Configuration& configuration) {
    const std::string path = blobOf_(configuration);
    const minirt_integrator integrator = renderDesc(levers_, configuration).integrator;
    const auto key = std::make_pair(path, integrator);
    const auto found = loaded_.find(key);
    if (found != loaded_.end()) return found->second;
    return loaded_[key] = {device_.load(path), kernelBytes(path, integrator)};
}

}  // namespace cost
