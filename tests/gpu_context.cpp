#include "gpu_context.hpp"

#include <doctest/doctest.h>

#include "support.hpp"

namespace test {

void collectMessage(void* messages, minirt_log_level level, const char* message) {
    if (level != MINIRT_LOG_WARNING) static_cast<std::vector<std::string>*>(messages)->push_back(message);
}

GpuContext::GpuContext(int validation) {
    minirt_context_desc desc = {};
    desc.log = collectMessage;
    desc.log_user = &messages_;
    desc.validation = validation;
    const minirt_result result = minirt_create(&desc, &context_);
    if (result == MINIRT_ERROR_NO_VULKAN || result == MINIRT_ERROR_NO_DEVICE) {
        skip("needs a Vulkan device");
        messages_.clear();
    } else {
        CHECK(result == MINIRT_OK);
    }
}

GpuContext::~GpuContext() {
    minirt_destroy(context_);
    for (const std::string& message : messages_) {
        INFO(message);
        CHECK(message.empty());
    }
}

bool GpuContext::isCpu() const {
    minirt_device_info info;
    minirt_get_device_info(context_, &info);
    return info.is_cpu != 0;
}

std::vector<std::string> GpuContext::takeMessages() {
    std::vector<std::string> taken;
    taken.swap(messages_);
    return taken;
}

}  // namespace test
