// A suite's texture as an image of the device, and a case's sampler: what hardware samplers are asked with.
#pragma once

#include "cli/vulkan/vulkan_device.h"

namespace rawtexel::cli {

/// Of flat textures and arrays, all levels. Throws scenes::InputError where the device has no such images.
class SuiteImage {
  public:
    SuiteImage(VulkanDevice& device, const SuiteTexture& texture);
    ~SuiteImage();
    SuiteImage(const SuiteImage&) = delete;
    SuiteImage& operator=(const SuiteImage&) = delete;

    VkImageView flat() const { return flat_; }    ///< the first layer
    VkImageView array() const { return array_; }  ///< all of them

  private:
    VkImageView make_view(VkImageViewType type, uint32_t layers);

    VulkanDevice& device_;
    VkFormat format_;
    uint32_t levels_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView flat_ = VK_NULL_HANDLE, array_ = VK_NULL_HANDLE;
};

/// The sampler of a case, as near as Vulkan has it: kernels other than nearest are linear, borders are transparent black.
VkSampler make_sampler(VulkanDevice& device, const CaseRecord& record);

/// Whether two cases can be asked with the same image and sampler.
bool share_sampler(const CaseRecord& a, const CaseRecord& b);

/// Whether the device can be asked with images of this texture at all.
bool can_sample(const VulkanDevice& device, const SuiteTexture& texture);

}  // namespace rawtexel::cli
