#ifdef RAWTEXEL_HAS_VULKAN
#include "cli/vulkan/vulkan_device.h"

#include "scenes/image_io.h"

#include <algorithm>
#include <cstring>
#include <dlfcn.h>

namespace rawtexel::cli {
namespace {

constexpr const char* kNoLoader =
    "no Vulkan loader (libvulkan.so.1): install libvulkan1 and a driver such as mesa-vulkan-drivers, or judge results made elsewhere with "
    "--outputs FILE";
constexpr const char* kNoDevice =
    "no Vulkan device: install a driver such as mesa-vulkan-drivers, whose lavapipe needs no GPU, or judge results made elsewhere with "
    "--outputs FILE";
constexpr uint64_t kPatience = uint64_t{60} * 1000 * 1000 * 1000;  // nanoseconds

std::string version_text(uint32_t version) {
    return std::to_string(VK_VERSION_MAJOR(version)) + "." + std::to_string(VK_VERSION_MINOR(version)) + "." +
           std::to_string(VK_VERSION_PATCH(version));
}

/// The loader and an instance.
struct Instance {
    void* library = nullptr;
    PFN_vkGetInstanceProcAddr get = nullptr;
    VkInstance handle = VK_NULL_HANDLE;

    template <class Function>
    Function find(const char* name) const {
        return reinterpret_cast<Function>(get(handle, name));
    }
};

Instance open_instance() {
    Instance instance;
    instance.library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (instance.library == nullptr) throw NoVulkan(kNoLoader);
    instance.get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(instance.library, "vkGetInstanceProcAddr"));
    if (instance.get == nullptr) throw NoVulkan(kNoLoader);
    const auto create = instance.find<PFN_vkCreateInstance>("vkCreateInstance");
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pNext = nullptr,
                                        .pApplicationName = "rawtexel",
                                        .applicationVersion = 1,
                                        .pEngineName = nullptr,
                                        .engineVersion = 0,
                                        .apiVersion = VK_API_VERSION_1_0};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = nullptr,
                                    .flags = 0,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = 0,
                                    .ppEnabledLayerNames = nullptr,
                                    .enabledExtensionCount = 0,
                                    .ppEnabledExtensionNames = nullptr};
    if (create == nullptr || create(&info, nullptr, &instance.handle) != VK_SUCCESS) throw NoVulkan(kNoDevice);
    return instance;
}

std::vector<VkPhysicalDevice> physical_devices(const Instance& instance) {
    const auto enumerate = instance.find<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices");
    uint32_t count = 0;
    if (enumerate(instance.handle, &count, nullptr) != VK_SUCCESS) count = 0;
    std::vector<VkPhysicalDevice> devices(count);
    if (count > 0) enumerate(instance.handle, &count, devices.data());
    devices.resize(count);
    return devices;
}

}  // namespace

void check(VkResult result, const char* call) {
    if (result != VK_SUCCESS) throw scenes::InputError(std::string("Vulkan: ") + call + " failed (" + std::to_string(int(result)) + ")");
}

VulkanDevice::VulkanDevice(const std::string& name) {
    const Instance instance = open_instance();
    library_ = instance.library;
    instance_ = instance.handle;
#define RAWTEXEL_LOAD(function) function = instance.find<PFN_##function>(#function);
    RAWTEXEL_VULKAN_INSTANCE_FUNCTIONS(RAWTEXEL_LOAD)
#undef RAWTEXEL_LOAD
    std::vector<std::string> names;
    for (const VkPhysicalDevice candidate : physical_devices(instance)) {
        VkPhysicalDeviceProperties found;
        vkGetPhysicalDeviceProperties(candidate, &found);
        names.emplace_back(found.deviceName);
        if (!name.empty() && names.back().find(name) == std::string::npos) continue;
        const bool better = physical_ == VK_NULL_HANDLE ||
                            (properties_.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && found.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU);
        if (better) physical_ = candidate, properties_ = found;
    }
    if (names.empty()) throw NoVulkan(kNoDevice);
    if (physical_ == VK_NULL_HANDLE) {
        std::string all;
        for (const std::string& each : names) all += (all.empty() ? "'" : ", '") + each + "'";
        throw NoVulkan("no Vulkan device has '" + name + "' in its name (there are: " + all + ")");
    }
    description_ = std::string(properties_.deviceName) + ", Vulkan " + version_text(properties_.apiVersion);
    vkGetPhysicalDeviceFeatures(physical_, &features_);
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);

    uint32_t families = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &families, nullptr);
    std::vector<VkQueueFamilyProperties> queues(families);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &families, queues.data());
    const auto computes = std::ranges::find_if(queues, [](const auto& queue) { return (queue.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
    if (computes == queues.end()) throw NoVulkan("'" + std::string(properties_.deviceName) + "' has no queue for compute shaders");
    const auto family = uint32_t(computes - queues.begin());
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .pNext = nullptr,
                                        .flags = 0,
                                        .queueFamilyIndex = family,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    VkPhysicalDeviceFeatures wanted{};
    wanted.samplerAnisotropy = features_.samplerAnisotropy;
    wanted.textureCompressionBC = features_.textureCompressionBC;
    wanted.shaderInt64 = features_.shaderInt64;
    wanted.shaderFloat64 = features_.shaderFloat64;
    wanted.shaderInt16 = features_.shaderInt16;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &wanted;
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
#define RAWTEXEL_LOAD(function) function = reinterpret_cast<PFN_##function>(vkGetDeviceProcAddr(device_, #function));
    RAWTEXEL_VULKAN_DEVICE_FUNCTIONS(RAWTEXEL_LOAD)
#undef RAWTEXEL_LOAD
    vkGetDeviceQueue(device_, family, 0, &queue_);
    const VkCommandPoolCreateInfo pool{
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .pNext = nullptr, .flags = 0, .queueFamilyIndex = family};
    check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
}

VulkanDevice::~VulkanDevice() {
    // What still runs may not be destroyed; the process ends soon.
    if (hung_) return;
    if (pool_ != VK_NULL_HANDLE) vkDestroyCommandPool(device_, pool_, nullptr);
    if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
    // The library stays: drivers keep threads and exit handlers of their own.
}

bool VulkanDevice::samples(VkFormat format) const {
    VkFormatProperties found;
    vkGetPhysicalDeviceFormatProperties(physical_, format, &found);
    constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    return (found.optimalTilingFeatures & kNeeded) == kNeeded;
}

VkDeviceMemory VulkanDevice::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags kind) const {
    for (uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
        if ((needs.memoryTypeBits >> type & 1) == 0 || (memory_.memoryTypes[type].propertyFlags & kind) != kind) continue;
        const VkMemoryAllocateInfo info{
            .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .pNext = nullptr, .allocationSize = needs.size, .memoryTypeIndex = type};
        VkDeviceMemory memory = VK_NULL_HANDLE;
        check(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
        return memory;
    }
    throw scenes::InputError("Vulkan: the device has no memory of the kind that is needed");
}

VkCommandBuffer VulkanDevice::begin() {
    check(vkResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .pNext = nullptr,
                                           .commandPool = pool_,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device_, &info, &commands), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo start{};
    start.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    start.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &start), "vkBeginCommandBuffer");
    return commands;
}

void VulkanDevice::submit(VkCommandBuffer commands) {
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkFenceCreateInfo fence_info{};
    fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    check(vkCreateFence(device_, &fence_info, nullptr, &fence), "vkCreateFence");
    VkSubmitInfo work{};
    work.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    work.commandBufferCount = 1;
    work.pCommandBuffers = &commands;
    VkResult result = vkQueueSubmit(queue_, 1, &work, fence);
    if (result == VK_SUCCESS) result = vkWaitForFences(device_, 1, &fence, VK_TRUE, kPatience);
    if (result == VK_TIMEOUT) {
        hung_ = true;
        throw scenes::InputError("the shader gave no answer within " + std::to_string(kPatience / 1000000000) + " s");
    }
    vkDestroyFence(device_, fence, nullptr);
    check(result, "vkQueueSubmit");
}

VulkanBuffer::VulkanBuffer(VulkanDevice& device, size_t bytes, VkBufferUsageFlags usage)
    : device_(device), size_(std::max<size_t>(bytes, 16)) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size_;
    info.usage = usage;
    check(device.vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements needs;
    device.vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
    memory_ = device.allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(device.vkBindBufferMemory(device.handle(), buffer_, memory_, 0), "vkBindBufferMemory");
    void* mapped = nullptr;
    check(device.vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    data_ = static_cast<std::byte*>(mapped);
    std::memset(data_, 0, size_);
}

VulkanBuffer::VulkanBuffer(VulkanDevice& device, std::span<const std::byte> contents, VkBufferUsageFlags usage)
    : VulkanBuffer(device, contents.size(), usage) {
    if (!contents.empty()) std::memcpy(data_, contents.data(), contents.size());
}

VulkanBuffer::~VulkanBuffer() {
    device_.vkDestroyBuffer(device_.handle(), buffer_, nullptr);
    device_.vkFreeMemory(device_.handle(), memory_, nullptr);
}

std::vector<std::string> vulkan_devices() {
    const Instance instance = open_instance();
    const auto properties = instance.find<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties");
    std::vector<std::string> names;
    for (const VkPhysicalDevice device : physical_devices(instance)) {
        VkPhysicalDeviceProperties found;
        properties(device, &found);
        names.emplace_back(found.deviceName);
    }
    instance.find<PFN_vkDestroyInstance>("vkDestroyInstance")(instance.handle, nullptr);
    return names;
}

}  // namespace rawtexel::cli
#endif
