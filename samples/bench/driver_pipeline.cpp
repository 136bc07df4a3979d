// By the specifications of VK_KHR_acceleration_structure and VK_KHR_ray_tracing_pipeline: one bottom level of opaque triangles, one
// instance of it, and two pipelines of the same three shaders, for closest and for any hits. Opaque triangles need no any-hit shader.
#include "driver_pipeline.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace bench {
namespace {

const char* const kRayGeneration = R"(#version 460
#extension GL_EXT_ray_tracing : require
layout(constant_id = 0) const bool ANY_HIT = false;
layout(push_constant) uniform CountBlock { uint count; };
struct Ray { vec3 origin; float unused; vec3 direction; float tMax; };
layout(binding = 0) uniform accelerationStructureEXT mesh;
layout(std430, binding = 1) readonly buffer RayBuffer { Ray rays[]; };
layout(std430, binding = 2) writeonly buffer HitBuffer { uvec2 hits[]; };
layout(location = 0) rayPayloadEXT uvec2 hit;
void main() {
    uint i = gl_LaunchIDEXT.x;
    if (i >= count) return;
    Ray ray = rays[i];
    hit = uvec2(floatBitsToUint(ray.tMax), 0u);
    uint flags = gl_RayFlagsOpaqueEXT;
    if (ANY_HIT) flags |= gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT;
    traceRayEXT(mesh, flags, 0xffu, 0u, 0u, 0u, ray.origin, 0.0, ray.direction, ray.tMax, 0);
    hits[i] = hit;
}
)";

const char* const kMiss = R"(#version 460
#extension GL_EXT_ray_tracing : require
layout(location = 0) rayPayloadInEXT uvec2 hit;
void main() { hit.y = 0xffffffffu; }
)";

const char* const kClosestHit = R"(#version 460
#extension GL_EXT_ray_tracing : require
layout(location = 0) rayPayloadInEXT uvec2 hit;
void main() { hit = uvec2(floatBitsToUint(gl_HitTEXT), gl_PrimitiveID); }
)";

const char* const kExtensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                   VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string("the driver's ray tracing pipeline: ") + call + " gave " + std::to_string(result));
}

template <typename T>
T described(VkStructureType type) {
    T value = {};
    value.sType = type;
    return value;
}

uint64_t aligned(uint64_t size, uint64_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

std::vector<uint32_t> compile(EShLanguage stage, const char* text) {
    glslang::InitializeProcess();  // counts its calls
    glslang::TShader shader(stage);
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_4);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    glslang::TProgram program;
    const bool parsed = shader.parse(GetDefaultResources(), 460, false, messages);
    if (parsed) program.addShader(&shader);
    if (!parsed || !program.link(messages))
        throw std::runtime_error(std::string("a shader of minirt-bench does not compile: ") + shader.getInfoLog());
    std::vector<uint32_t> spirv;
    glslang::GlslangToSpv(*program.getIntermediate(stage), spirv);
    return spirv;
}

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    VkDeviceAddress address = 0;
};

struct Structure {
    Buffer buffer;
    VkAccelerationStructureKHR handle = VK_NULL_HANDLE;
    double buildMs = 0;
};

/// The functions of the extensions.
struct Functions {
    PFN_vkGetAccelerationStructureBuildSizesKHR buildSizes;
    PFN_vkCreateAccelerationStructureKHR createStructure;
    PFN_vkDestroyAccelerationStructureKHR destroyStructure;
    PFN_vkCmdBuildAccelerationStructuresKHR build;
    PFN_vkGetAccelerationStructureDeviceAddressKHR structureAddress;
    PFN_vkCreateRayTracingPipelinesKHR createPipelines;
    PFN_vkGetRayTracingShaderGroupHandlesKHR groupHandles;
    PFN_vkCmdTraceRaysKHR traceRays;
};

template <typename F>
void get(VkDevice device, const char* name, F& function) {
    function = reinterpret_cast<F>(vkGetDeviceProcAddr(device, name));
    if (!function) throw std::runtime_error(std::string("the driver's ray tracing pipeline: no ") + name);
}

Functions functionsOf(VkDevice device) {
    Functions f;
    get(device, "vkGetAccelerationStructureBuildSizesKHR", f.buildSizes);
    get(device, "vkCreateAccelerationStructureKHR", f.createStructure);
    get(device, "vkDestroyAccelerationStructureKHR", f.destroyStructure);
    get(device, "vkCmdBuildAccelerationStructuresKHR", f.build);
    get(device, "vkGetAccelerationStructureDeviceAddressKHR", f.structureAddress);
    get(device, "vkCreateRayTracingPipelinesKHR", f.createPipelines);
    get(device, "vkGetRayTracingShaderGroupHandlesKHR", f.groupHandles);
    get(device, "vkCmdTraceRaysKHR", f.traceRays);
    return f;
}

VkPhysicalDevice findDevice(VkInstance instance, const std::string& name) {
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vkEnumeratePhysicalDevices(instance, &count, devices.data());
    for (VkPhysicalDevice device : devices) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(device, &properties);
        if (name == properties.deviceName) return device;
    }
    return VK_NULL_HANDLE;
}

/// "" where the device offers all that is used.
std::string lackOf(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_2) return "no Vulkan 1.2";
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> offered(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, offered.data());
    for (const char* wanted : kExtensions)
        if (std::none_of(offered.begin(), offered.end(),
                         [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, wanted) == 0; }))
            return std::string("no ") + wanted;
    auto address =
        described<VkPhysicalDeviceBufferDeviceAddressFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES);
    auto all = described<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    all.pNext = &address;
    vkGetPhysicalDeviceFeatures2(device, &all);
    return address.bufferDeviceAddress ? "" : "no bufferDeviceAddress";
}

uint32_t queueFamilyOf(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (uint32_t i = 0; i < count; ++i)
        if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0 && families[i].timestampValidBits > 0) return i;
    throw std::runtime_error("the driver's ray tracing pipeline: no compute queue with timestamps");
}

constexpr VkBufferUsageFlags kStructureInput =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr uint32_t kGroups = 3;  // ray generation, miss, hit

}  // namespace

struct DriverPipeline::Insides {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t family = 0;
    Functions vk = {};
    double tickNs = 0;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkQueryPool queries = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorPool descriptorPool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkPipeline pipelines[2] = {};  // closest, any
    Buffer tables[2];
    VkDeviceSize tableStride = 0;
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR tracing = {};
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structures = {};
    VkPhysicalDeviceLimits limits = {};
    Structure bottom, top;
    Buffer rays, hits;
    uint32_t rayCount = 0;

    ~Insides();
    void openDevice();
    void openCommands();
    Buffer create(VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags wanted);
    void destroy(Buffer& buffer);
    void destroy(Structure& structure);
    void write(const Buffer& staging, const void* data, size_t size);
    Buffer upload(const void* data, size_t size, VkBufferUsageFlags usage);
    template <typename Record>
    double submit(const Record& record);
    Structure buildStructure(VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry,
                             uint32_t count);
    void buildBottom(const Triangles& mesh);
    void buildTop();
    void makeLayouts();
    void makePipelines();
    void makeTable(int any);
    void bind();
};

void DriverPipeline::Insides::openDevice() {
    const float priority = 1;
    auto queueInfo = described<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = family = queueFamilyOf(physical);
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    auto address =
        described<VkPhysicalDeviceBufferDeviceAddressFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES);
    address.bufferDeviceAddress = VK_TRUE;
    auto structure = described<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
    structure.pNext = &address;
    structure.accelerationStructure = VK_TRUE;
    auto pipeline = described<VkPhysicalDeviceRayTracingPipelineFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR);
    pipeline.pNext = &structure;
    pipeline.rayTracingPipeline = VK_TRUE;
    auto info = described<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &pipeline;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = static_cast<uint32_t>(std::size(kExtensions));
    info.ppEnabledExtensionNames = kExtensions;
    check(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
    vkGetDeviceQueue(device, family, 0, &queue);
    vk = functionsOf(device);

    structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
    tracing.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
    tracing.pNext = &structures;
    auto properties = described<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &tracing;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    limits = properties.properties.limits;
    tickNs = static_cast<double>(limits.timestampPeriod);
}

void DriverPipeline::Insides::openCommands() {
    auto poolInfo = described<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    poolInfo.queueFamilyIndex = family;
    check(vkCreateCommandPool(device, &poolInfo, nullptr, &pool), "vkCreateCommandPool");
    auto info = described<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device, &info, &commands), "vkAllocateCommandBuffers");
    auto queryInfo = described<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    queryInfo.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queryInfo.queryCount = 2;
    check(vkCreateQueryPool(device, &queryInfo, nullptr, &queries), "vkCreateQueryPool");
}

Buffer DriverPipeline::Insides::create(VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags wanted) {
    Buffer out;
    out.size = size;
    auto info = described<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = size;
    info.usage = usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    check(vkCreateBuffer(device, &info, nullptr, &out.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, out.buffer, &needs);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           ((needs.memoryTypeBits >> type & 1u) == 0 || (memory.memoryTypes[type].propertyFlags & wanted) != wanted))
        ++type;
    if (type == memory.memoryTypeCount) check(VK_ERROR_FEATURE_NOT_PRESENT, "the search for memory");
    auto flags = described<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    auto allocate = described<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    allocate.pNext = &flags;
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = type;
    check(vkAllocateMemory(device, &allocate, nullptr, &out.memory), "vkAllocateMemory");
    check(vkBindBufferMemory(device, out.buffer, out.memory, 0), "vkBindBufferMemory");
    auto which = described<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
    which.buffer = out.buffer;
    out.address = vkGetBufferDeviceAddress(device, &which);
    return out;
}

void DriverPipeline::Insides::destroy(Buffer& buffer) {
    vkDestroyBuffer(device, buffer.buffer, nullptr);
    vkFreeMemory(device, buffer.memory, nullptr);
    buffer = {};
}

void DriverPipeline::Insides::destroy(Structure& structure) {
    if (structure.handle) vk.destroyStructure(device, structure.handle, nullptr);
    destroy(structure.buffer);
    structure = {};
}

void DriverPipeline::Insides::write(const Buffer& staging, const void* data, size_t size) {
    void* mapped = nullptr;
    check(vkMapMemory(device, staging.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    std::memcpy(mapped, data, size);
    vkUnmapMemory(device, staging.memory);
}

constexpr VkMemoryPropertyFlags kHostMemory = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

Buffer DriverPipeline::Insides::upload(const void* data, size_t size, VkBufferUsageFlags usage) {
    Buffer staging = create(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kHostMemory);
    write(staging, data, size);
    const Buffer out = create(size, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    submit([&] {
        const VkBufferCopy region = {0, 0, size};
        vkCmdCopyBuffer(commands, staging.buffer, out.buffer, 1, &region);
    });
    destroy(staging);
    return out;
}

/// Runs what `record` records and waits; returns milliseconds by the device's clock. What ran before is visible to it, it to the host.
template <typename Record>
double DriverPipeline::Insides::submit(const Record& record) {
    auto begin = described<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    vkCmdResetQueryPool(commands, queries, 0, 2);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries, 0);
    record();
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries, 1);
    auto barrier = described<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    auto info = described<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    check(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
    uint64_t ticks[2] = {};
    check(vkGetQueryPoolResults(device, queries, 0, 2, sizeof ticks, ticks, sizeof ticks[0], VK_QUERY_RESULT_64_BIT),
          "vkGetQueryPoolResults");
    return static_cast<double>(ticks[1] - ticks[0]) * tickNs * 1e-6;
}

Structure DriverPipeline::Insides::buildStructure(VkAccelerationStructureTypeKHR type,
                                                  const VkAccelerationStructureGeometryKHR& geometry, uint32_t count) {
    auto build =
        described<VkAccelerationStructureBuildGeometryInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR);
    build.type = type;
    build.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    build.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    build.geometryCount = 1;
    build.pGeometries = &geometry;
    auto sizes =
        described<VkAccelerationStructureBuildSizesInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR);
    vk.buildSizes(device, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &build, &count, &sizes);
    Structure out;
    out.buffer = create(sizes.accelerationStructureSize, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR,
                        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    auto info = described<VkAccelerationStructureCreateInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR);
    info.buffer = out.buffer.buffer;
    info.size = sizes.accelerationStructureSize;
    info.type = type;
    check(vk.createStructure(device, &info, nullptr, &out.handle), "vkCreateAccelerationStructureKHR");
    const VkDeviceSize alignment = std::max(1u, structures.minAccelerationStructureScratchOffsetAlignment);
    Buffer scratch =
        create(sizes.buildScratchSize + alignment, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    build.dstAccelerationStructure = out.handle;
    build.scratchData.deviceAddress = aligned(scratch.address, alignment);
    const VkAccelerationStructureBuildRangeInfoKHR range = {count, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    out.buildMs = submit([&] { vk.build(commands, 1, &build, &ranges); });
    destroy(scratch);
    return out;
}

void DriverPipeline::Insides::buildBottom(const Triangles& mesh) {
    Buffer vertices = upload(mesh.data(), mesh.size() * sizeof(Triangle), kStructureInput);
    auto geometry = described<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
    triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = vertices.address;
    triangles.vertexStride = sizeof(glm::vec3);
    triangles.maxVertex = static_cast<uint32_t>(3 * mesh.size() - 1);
    triangles.indexType = VK_INDEX_TYPE_NONE_KHR;
    bottom = buildStructure(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometry, static_cast<uint32_t>(mesh.size()));
    destroy(vertices);
}

void DriverPipeline::Insides::buildTop() {
    auto which =
        described<VkAccelerationStructureDeviceAddressInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR);
    which.accelerationStructure = bottom.handle;
    VkAccelerationStructureInstanceKHR instanceData = {};
    for (int i = 0; i < 3; ++i) instanceData.transform.matrix[i][i] = 1;
    instanceData.mask = 0xff;
    instanceData.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instanceData.accelerationStructureReference = vk.structureAddress(device, &which);
    Buffer instances = upload(&instanceData, sizeof instanceData, kStructureInput);
    auto geometry = described<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
    geometry.geometry.instances.data.deviceAddress = instances.address;
    top = buildStructure(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, geometry, 1);
    destroy(instances);
}

void DriverPipeline::Insides::makeLayouts() {
    const VkDescriptorType types[] = {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                      VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    VkDescriptorSetLayoutBinding bindings[3];
    for (uint32_t i = 0; i < 3; ++i) bindings[i] = {i, types[i], 1, VK_SHADER_STAGE_RAYGEN_BIT_KHR, nullptr};
    auto setInfo = described<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    setInfo.bindingCount = 3;
    setInfo.pBindings = bindings;
    check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout), "vkCreateDescriptorSetLayout");
    const VkPushConstantRange push = {VK_SHADER_STAGE_RAYGEN_BIT_KHR, 0, sizeof rayCount};
    auto info = described<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = &setLayout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(device, &info, nullptr, &layout), "vkCreatePipelineLayout");
    const VkDescriptorPoolSize sizes[] = {{types[0], 1}, {types[1], 2}};
    auto poolInfo = described<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = 2;
    poolInfo.pPoolSizes = sizes;
    check(vkCreateDescriptorPool(device, &poolInfo, nullptr, &descriptorPool), "vkCreateDescriptorPool");
    auto allocate = described<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = descriptorPool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout;
    check(vkAllocateDescriptorSets(device, &allocate, &set), "vkAllocateDescriptorSets");
}

void DriverPipeline::Insides::makePipelines() {
    const std::pair<EShLanguage, const char*> sources[] = {
        {EShLangRayGen, kRayGeneration}, {EShLangMiss, kMiss}, {EShLangClosestHit, kClosestHit}};
    const VkShaderStageFlagBits stageBits[] = {VK_SHADER_STAGE_RAYGEN_BIT_KHR, VK_SHADER_STAGE_MISS_BIT_KHR,
                                               VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR};
    VkPipelineShaderStageCreateInfo stages[kGroups];
    VkRayTracingShaderGroupCreateInfoKHR groups[kGroups];
    for (uint32_t i = 0; i < kGroups; ++i) {
        const std::vector<uint32_t> spirv = compile(sources[i].first, sources[i].second);
        auto moduleInfo = described<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        moduleInfo.codeSize = spirv.size() * sizeof(uint32_t);
        moduleInfo.pCode = spirv.data();
        stages[i] = described<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        check(vkCreateShaderModule(device, &moduleInfo, nullptr, &stages[i].module), "vkCreateShaderModule");
        stages[i].stage = stageBits[i];
        stages[i].pName = "main";
        groups[i] = described<VkRayTracingShaderGroupCreateInfoKHR>(VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR);
        const bool hit = i == 2;
        groups[i].type =
            hit ? VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR : VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
        groups[i].generalShader = hit ? VK_SHADER_UNUSED_KHR : i;
        groups[i].closestHitShader = hit ? i : VK_SHADER_UNUSED_KHR;
        groups[i].anyHitShader = groups[i].intersectionShader = VK_SHADER_UNUSED_KHR;
    }
    auto info = described<VkRayTracingPipelineCreateInfoKHR>(VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR);
    info.stageCount = info.groupCount = kGroups;
    info.pStages = stages;
    info.pGroups = groups;
    info.maxPipelineRayRecursionDepth = 1;
    info.layout = layout;
    for (VkBool32 any = 0; any < 2; ++any) {
        const VkSpecializationMapEntry entry = {0, 0, sizeof any};
        const VkSpecializationInfo constants = {1, &entry, sizeof any, &any};
        stages[0].pSpecializationInfo = &constants;
        check(vk.createPipelines(device, VK_NULL_HANDLE, VK_NULL_HANDLE, 1, &info, nullptr, &pipelines[any]),
              "vkCreateRayTracingPipelinesKHR");
    }
    for (const VkPipelineShaderStageCreateInfo& stage : stages) vkDestroyShaderModule(device, stage.module, nullptr);
}

/// A group's handle in each stride: ray generation, miss, hit.
void DriverPipeline::Insides::makeTable(int any) {
    const uint32_t handleSize = tracing.shaderGroupHandleSize;
    tableStride = aligned(aligned(handleSize, tracing.shaderGroupHandleAlignment), tracing.shaderGroupBaseAlignment);
    std::vector<uint8_t> handles(size_t{handleSize} * kGroups);
    check(vk.groupHandles(device, pipelines[any], 0, kGroups, handles.size(), handles.data()),
          "vkGetRayTracingShaderGroupHandlesKHR");
    std::vector<uint8_t> table(tableStride * kGroups);
    for (uint32_t i = 0; i < kGroups; ++i) std::memcpy(&table[i * tableStride], &handles[size_t{i} * handleSize], handleSize);
    tables[any] = upload(table.data(), table.size(), VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR);
    if (tables[any].address % tracing.shaderGroupBaseAlignment != 0)
        throw std::runtime_error("the driver's ray tracing pipeline: a shader binding table is not aligned");
}

void DriverPipeline::Insides::bind() {
    auto structure = described<VkWriteDescriptorSetAccelerationStructureKHR>(
        VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR);
    structure.accelerationStructureCount = 1;
    structure.pAccelerationStructures = &top.handle;
    const VkDescriptorBufferInfo buffers[] = {{rays.buffer, 0, VK_WHOLE_SIZE}, {hits.buffer, 0, VK_WHOLE_SIZE}};
    VkWriteDescriptorSet writes[3];
    for (uint32_t i = 0; i < 3; ++i) {
        writes[i] = described<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = i == 0 ? VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = i == 0 ? nullptr : &buffers[i - 1];
    }
    writes[0].pNext = &structure;
    vkUpdateDescriptorSets(device, 3, writes, 0, nullptr);
}

DriverPipeline::Insides::~Insides() {
    if (device) {
        for (Buffer* buffer : {&tables[0], &tables[1], &rays, &hits}) destroy(*buffer);
        destroy(top);
        destroy(bottom);
        for (VkPipeline pipeline : pipelines) vkDestroyPipeline(device, pipeline, nullptr);
        vkDestroyDescriptorPool(device, descriptorPool, nullptr);
        vkDestroyPipelineLayout(device, layout, nullptr);
        vkDestroyDescriptorSetLayout(device, setLayout, nullptr);
        vkDestroyQueryPool(device, queries, nullptr);
        vkDestroyCommandPool(device, pool, nullptr);
        vkDestroyDevice(device, nullptr);
    }
    if (instance) vkDestroyInstance(instance, nullptr);
}

std::unique_ptr<DriverPipeline> DriverPipeline::open(const std::string& deviceName, std::string& whyNot) {
    auto insides = std::make_unique<Insides>();
    auto application = described<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.apiVersion = VK_API_VERSION_1_2;
    auto info = described<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    check(vkCreateInstance(&info, nullptr, &insides->instance), "vkCreateInstance");
    insides->physical = findDevice(insides->instance, deviceName);
    whyNot = insides->physical ? lackOf(insides->physical) : "no such device";
    if (!whyNot.empty()) {
        whyNot = deviceName + " has " + whyNot;
        return nullptr;
    }
    insides->openDevice();
    insides->openCommands();
    insides->makeLayouts();
    insides->makePipelines();
    insides->makeTable(0);
    insides->makeTable(1);
    return std::unique_ptr<DriverPipeline>(new DriverPipeline(std::move(insides)));
}

DriverPipeline::DriverPipeline(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
DriverPipeline::~DriverPipeline() = default;

void DriverPipeline::setMesh(const Triangles& mesh) {
    insides_->destroy(insides_->top);
    insides_->destroy(insides_->bottom);
    insides_->buildBottom(mesh);
    insides_->buildTop();
}

double DriverPipeline::buildMs() const {
    return insides_->bottom.buildMs + insides_->top.buildMs;
}

uint64_t DriverPipeline::structureBytes() const {
    return insides_->bottom.buffer.size + insides_->top.buffer.size;
}

void DriverPipeline::setRays(const std::vector<Ray>& rays) {
    const uint64_t widest = uint64_t{insides_->limits.maxComputeWorkGroupCount[0]} * insides_->limits.maxComputeWorkGroupSize[0];
    if (rays.size() > std::min<uint64_t>(widest, insides_->tracing.maxRayDispatchInvocationCount))
        throw std::runtime_error("the driver's ray tracing pipeline: too many rays for a launch");
    insides_->destroy(insides_->rays);
    insides_->destroy(insides_->hits);
    insides_->rayCount = static_cast<uint32_t>(rays.size());
    insides_->rays = insides_->upload(rays.data(), rays.size() * sizeof(Ray), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    insides_->hits =
        insides_->create(rays.size() * sizeof(Hit), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                         VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    insides_->bind();
}

double DriverPipeline::trace(bool anyHit) {
    Insides& in = *insides_;
    const int any = anyHit ? 1 : 0;
    const auto region = [&](uint32_t group) {
        return VkStridedDeviceAddressRegionKHR{in.tables[any].address + group * in.tableStride, in.tableStride, in.tableStride};
    };
    const VkStridedDeviceAddressRegionKHR generation = region(0), miss = region(1), hit = region(2), callable = {};
    return in.submit([&] {
        vkCmdBindPipeline(in.commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, in.pipelines[any]);
        vkCmdBindDescriptorSets(in.commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, in.layout, 0, 1, &in.set, 0, nullptr);
        vkCmdPushConstants(in.commands, in.layout, VK_SHADER_STAGE_RAYGEN_BIT_KHR, 0, sizeof in.rayCount, &in.rayCount);
        in.vk.traceRays(in.commands, &generation, &miss, &hit, &callable, in.rayCount, 1, 1);
    });
}

std::vector<Hit> DriverPipeline::hits() {
    static_assert(sizeof(Hit) == 8, "the layout that the shader writes");
    Insides& in = *insides_;
    const size_t size = in.rayCount * sizeof(Hit);
    Buffer copy = in.create(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, kHostMemory);
    in.submit([&] {
        const VkBufferCopy region = {0, 0, size};
        vkCmdCopyBuffer(in.commands, in.hits.buffer, copy.buffer, 1, &region);
    });
    std::vector<Hit> result(in.rayCount);
    void* mapped = nullptr;
    check(vkMapMemory(in.device, copy.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    std::memcpy(result.data(), mapped, size);
    vkUnmapMemory(in.device, copy.memory);
    in.destroy(copy);
    return result;
}

}  // namespace bench
