// The runtime makes its pipelines as ever, but finds in this file two functions of Vulkan: one that opens the device with the extension, and
// one that asks for statistics of each pipeline and takes them down.
#include "kernel_statistics.hpp"

#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstring>
#include <mutex>

#include "stage.hpp"

namespace bench {
namespace {

/// Functions of the driver, and what they gave; Vulkan's functions have no argument to pass it in.
struct Recorder {
    PFN_vkCreateDevice createDevice = nullptr;
    PFN_vkGetDeviceProcAddr deviceFunction = nullptr;
    PFN_vkCreateComputePipelines createPipelines = nullptr;
    PFN_vkGetPipelineExecutablePropertiesKHR programs = nullptr;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics = nullptr;
    std::vector<KernelStatistics> found;
};
Recorder recorder;

template <typename T>
T described(VkStructureType type) {
    T value = {};
    value.sType = type;
    return value;
}

bool tells(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> offered(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, offered.data());
    return std::any_of(offered.begin(), offered.end(), [](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME) == 0;
    });
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* out) {
    if (!tells(physical)) return recorder.createDevice(physical, info, allocator, out);
    VkDeviceCreateInfo more = *info;
    std::vector<const char*> extensions(info->ppEnabledExtensionNames,
                                        info->ppEnabledExtensionNames + info->enabledExtensionCount);
    extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    more.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    more.ppEnabledExtensionNames = extensions.data();
    auto feature = described<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
    feature.pipelineExecutableInfo = VK_TRUE;
    feature.pNext = const_cast<void*>(info->pNext);
    more.pNext = &feature;
    const VkResult result = recorder.createDevice(physical, &more, allocator, out);
    if (result != VK_SUCCESS) return recorder.createDevice(physical, info, allocator, out);
    recorder.programs = reinterpret_cast<PFN_vkGetPipelineExecutablePropertiesKHR>(
        vkGetDeviceProcAddr(*out, "vkGetPipelineExecutablePropertiesKHR"));
    recorder.statistics = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        vkGetDeviceProcAddr(*out, "vkGetPipelineExecutableStatisticsKHR"));
    return result;
}

double valueOf(const VkPipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
            return statistic.value.b32 ? 1 : 0;
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
            return static_cast<double>(statistic.value.i64);
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
            // Registers and bytes of a kernel need no more; a driver (NVIDIA 580) has 16 in the upper half of its sizes.
            return static_cast<double>(statistic.value.u64 & 0xffffffffu);
        default:
            return statistic.value.f64;
    }
}

/// All that one of the extension's two functions tells of `info`.
template <typename T, typename Query, typename Info>
std::vector<T> allOf(Query query, VkDevice device, const Info& info, VkStructureType type) {
    uint32_t count = 0;
    query(device, &info, &count, nullptr);
    std::vector<T> all(count, described<T>(type));
    query(device, &info, &count, all.data());
    all.resize(count);
    return all;
}

KernelStatistics statisticsOf(VkDevice device, VkPipeline pipeline, uint32_t program, const char* name) {
    auto info = described<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
    info.pipeline = pipeline;
    info.executableIndex = program;
    KernelStatistics found{name, {}};
    for (const auto& value : allOf<VkPipelineExecutableStatisticKHR>(recorder.statistics, device, info,
                                                                     VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR))
        found.figures.emplace_back(value.name, valueOf(value));
    return found;
}

void takeDown(VkDevice device, VkPipeline pipeline) {
    auto info = described<VkPipelineInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR);
    info.pipeline = pipeline;
    const auto programs = allOf<VkPipelineExecutablePropertiesKHR>(recorder.programs, device, info,
                                                                   VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR);
    for (uint32_t i = 0; i < programs.size(); ++i) recorder.found.push_back(statisticsOf(device, pipeline, i, programs[i].name));
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                               const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* allocator,
                                               VkPipeline* out) {
    if (!recorder.programs || !recorder.statistics) return recorder.createPipelines(device, cache, count, infos, allocator, out);
    std::vector<VkComputePipelineCreateInfo> asking(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : asking) info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    const VkResult result = recorder.createPipelines(device, cache, count, asking.data(), allocator, out);
    static std::mutex oneAtATime;  // the runtime makes pipelines on several threads
    const std::lock_guard<std::mutex> lock(oneAtATime);
    for (uint32_t i = 0; result == VK_SUCCESS && i < count; ++i) takeDown(device, out[i]);
    return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice device, const char* name) {
    const PFN_vkVoidFunction real = recorder.deviceFunction(device, name);
    if (std::strcmp(name, "vkCreateComputePipelines") != 0) return real;
    recorder.createPipelines = reinterpret_cast<PFN_vkCreateComputePipelines>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(createPipelines);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceFunction(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction real = vkGetInstanceProcAddr(instance, name);
    if (std::strcmp(name, "vkCreateDevice") == 0) {
        recorder.createDevice = reinterpret_cast<PFN_vkCreateDevice>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(createDevice);
    }
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        recorder.deviceFunction = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(deviceFunction);
    }
    return real;
}

}  // namespace

double largestFigure(const std::vector<KernelStatistics>& statistics, const std::vector<std::string>& words) {
    double largest = -1;
    for (const KernelStatistics& program : statistics)
        for (const auto& [name, value] : program.figures)
            for (const std::string& word : words)
                if (name.find(word) != std::string::npos) largest = std::max(largest, value);
    return largest;
}

std::vector<KernelStatistics> statisticsOf(const std::string& device, const std::function<void(minirt_context*)>& make) {
    recorder = {};
    const Stage stage(device, "", instanceFunction);
    if (recorder.programs && recorder.statistics) make(stage.context());
    return std::move(recorder.found);
}

std::vector<KernelStatistics> kernelStatistics(const std::string& device, const std::string& blob) {
    recorder = {};
    Stage stage(device, blob, instanceFunction);
    stage.load();
    stage.resize(8, 8);
    minirt_stats ignored = {};
    stage.render(MINIRT_INTEGRATOR_SCENE, 1, ignored);
    return std::move(recorder.found);
}

}  // namespace bench
