#include "device.hpp"

#include <cstdio>
#include <stdexcept>

namespace {

const char* hintFor(minirt_result result) {
    switch (result) {
        case MINIRT_ERROR_NOT_A_BLOB:
            return "; bake a scene with: minirtc bake SCENE.json -o SCENE.mrt";
        case MINIRT_ERROR_CORRUPT:
        case MINIRT_ERROR_SECTION_OUT_OF_BOUNDS:
        case MINIRT_ERROR_SECTION_MISSING:
            return "; bake the scene again";
        default:
            return "";
    }
}

}  // namespace

Device::Device(const std::string& name, bool validation) : name_(name) {
    minirt_context_desc desc = {};
    desc.device_name = name.c_str();
    desc.validation = validation ? 1 : 0;
    desc.log = keepMessage;
    desc.log_user = this;
    require(minirt_create(&desc, &context_), "");
}

minirt_scene* Device::load(const std::string& path) {
    minirt_scene* scene = nullptr;
    require(minirt_load_file(context_, path.c_str(), &scene), path);
    return scene;
}

void Device::require(minirt_result result, const std::string& where) const {
    if (result == MINIRT_OK) return;
    std::string message = error_.empty() ? minirt_result_string(result) : error_;
    const std::string prefix = where.empty() ? "" : where + ": ";
    if (message.compare(0, prefix.size(), prefix) != 0) message = prefix + message;
    throw std::runtime_error(message + hintFor(result));
}

minirt_device_info Device::info() const {
    minirt_device_info info;
    minirt_get_device_info(context_, &info);
    return info;
}

void Device::keepMessage(void* self, minirt_log_level level, const char* message) {
    if (level == MINIRT_LOG_ERROR)
        static_cast<Device*>(self)->error_ = message;
    else
        std::fprintf(stderr, "%s\n", message);
}
