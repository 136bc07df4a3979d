// A Vulkan device as an application has one: made without the runtime, with the validation layer on it.
#pragma once
#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <vector>

#include "minirt.h"

namespace test {

/// Destroyed after everything that uses it. What the layer says fails the running case when the object goes.
class HostDevice {
public:
    HostDevice();
    ~HostDevice();
    HostDevice(const HostDevice&) = delete;
    HostDevice& operator=(const HostDevice&) = delete;

    explicit operator bool() const { return device_ != VK_NULL_HANDLE; }
    minirt_host_device desc() const;
    /// Calls `record` with a command buffer and an image of R32G32B32A32_SFLOAT in TRANSFER_DST_OPTIMAL, submits, waits, and returns
    /// the image's texels.
    std::vector<float> recordToImage(uint32_t width, uint32_t height,
                                     const std::function<void(VkCommandBuffer, VkImage)>& record) const;

private:
    void createInstance();
    void createDevice();
    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) const;

    std::vector<std::string> messages_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t family_ = 0;
    VkCommandPool pool_ = VK_NULL_HANDLE;
};

}  // namespace test
