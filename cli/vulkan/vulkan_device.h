// A Vulkan device with one queue for compute, and what is allocated from it. Only files of this folder see Vulkan's headers.
#pragma once

#include "cli/vulkan/port_runner.h"

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::cli {

// clang-format off
#define RAWTEXEL_VULKAN_INSTANCE_FUNCTIONS(use)                                                                             \
    use(vkDestroyInstance) use(vkEnumeratePhysicalDevices) use(vkGetPhysicalDeviceProperties)                               \
    use(vkGetPhysicalDeviceFeatures) use(vkGetPhysicalDeviceQueueFamilyProperties) use(vkGetPhysicalDeviceMemoryProperties) \
    use(vkGetPhysicalDeviceFormatProperties) use(vkCreateDevice) use(vkGetDeviceProcAddr)
#define RAWTEXEL_VULKAN_DEVICE_FUNCTIONS(use)                                                                               \
    use(vkDestroyDevice) use(vkGetDeviceQueue) use(vkCreateBuffer) use(vkDestroyBuffer) use(vkGetBufferMemoryRequirements)  \
    use(vkAllocateMemory) use(vkFreeMemory) use(vkBindBufferMemory) use(vkMapMemory) use(vkUnmapMemory)                     \
    use(vkCreateShaderModule) use(vkDestroyShaderModule) use(vkCreateDescriptorSetLayout) use(vkDestroyDescriptorSetLayout) \
    use(vkCreatePipelineLayout) use(vkDestroyPipelineLayout) use(vkCreateComputePipelines) use(vkDestroyPipeline)           \
    use(vkCreateDescriptorPool) use(vkDestroyDescriptorPool) use(vkAllocateDescriptorSets) use(vkUpdateDescriptorSets)      \
    use(vkCreateCommandPool) use(vkDestroyCommandPool) use(vkAllocateCommandBuffers) use(vkBeginCommandBuffer)              \
    use(vkEndCommandBuffer) use(vkCmdBindPipeline) use(vkCmdBindDescriptorSets) use(vkCmdPushConstants) use(vkCmdDispatch)  \
    use(vkCmdPipelineBarrier) use(vkCmdCopyBufferToImage) use(vkQueueSubmit) use(vkCreateFence) use(vkDestroyFence)         \
    use(vkWaitForFences) use(vkCreateImage) use(vkDestroyImage) use(vkGetImageMemoryRequirements) use(vkBindImageMemory)    \
    use(vkCreateImageView) use(vkDestroyImageView) use(vkCreateSampler) use(vkDestroySampler) use(vkResetFences)            \
    use(vkResetCommandPool) use(vkDeviceWaitIdle)
// clang-format on

/// Throws NoVulkan, or where a call of a device fails scenes::InputError.
class VulkanDevice {
  public:
    /// See run_port.
    explicit VulkanDevice(const std::string& name);
    ~VulkanDevice();
    VulkanDevice(const VulkanDevice&) = delete;
    VulkanDevice& operator=(const VulkanDevice&) = delete;

    const std::string& description() const { return description_; }
    const VkPhysicalDeviceProperties& properties() const { return properties_; }
    const VkPhysicalDeviceFeatures& features() const { return features_; }
    VkDevice handle() const { return device_; }
    bool samples(VkFormat format) const;

    /// Of the kind asked for; throws where there is none.
    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags kind) const;

    /// Records, submits and waits. Throws where there is no answer within a minute, and then leaves everything as it is.
    template <class Record>
    void run(const Record& record) {
        const VkCommandBuffer commands = begin();
        record(commands);
        submit(commands);
    }

#define RAWTEXEL_MEMBER(name) PFN_##name name = nullptr;
    RAWTEXEL_VULKAN_INSTANCE_FUNCTIONS(RAWTEXEL_MEMBER)
    RAWTEXEL_VULKAN_DEVICE_FUNCTIONS(RAWTEXEL_MEMBER)
#undef RAWTEXEL_MEMBER

  private:
    VkCommandBuffer begin();
    void submit(VkCommandBuffer commands);

    void* library_ = nullptr;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceFeatures features_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    std::string description_;
    bool hung_ = false;
};

/// Throws scenes::InputError "Vulkan: CALL failed (CODE)" unless it succeeded.
void check(VkResult result, const char* call);

/// Memory that this side sees, too.
class VulkanBuffer {
  public:
    VulkanBuffer(VulkanDevice& device, size_t bytes, VkBufferUsageFlags usage);
    VulkanBuffer(VulkanDevice& device, std::span<const std::byte> contents, VkBufferUsageFlags usage);
    ~VulkanBuffer();
    VulkanBuffer(const VulkanBuffer&) = delete;
    VulkanBuffer& operator=(const VulkanBuffer&) = delete;

    VkBuffer handle() const { return buffer_; }
    std::byte* data() const { return data_; }
    size_t size() const { return size_; }

  private:
    VulkanDevice& device_;
    size_t size_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::byte* data_ = nullptr;
};

}  // namespace rawtexel::cli
