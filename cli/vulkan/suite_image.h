// A suite's texture as an image of the device, and a case's sampler: what hardware samplers are asked with.
#pragma once

#include "cli/vulkan/vulkan_device.h"

namespace rawtexel::cli {

/// The binding at which shaders ask for images of this shape (cli/vulkan/spirv_module.h).
uint32_t image_binding(const texunit::Shape& shape);

/// All levels of a texture, as the image of its binding. Throws scenes::InputError where the device has no
/// such images.
class SuiteImage {
  public:
    SuiteImage(VulkanDevice& device, const SuiteTexture& texture);
    ~SuiteImage();
    SuiteImage(const SuiteImage&) = delete;
    SuiteImage& operator=(const SuiteImage&) = delete;

    VkImageView view() const { return view_; }

  private:
    void upload(const SuiteTexture& texture);
    void make_view(uint32_t binding, VkFormat format);

    VulkanDevice& device_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
};

/// What is bound where a case's texture is of another kind: an image of a single texel, or six.
SuiteTexture blank_texture(uint32_t binding);

/// The sampler of a case, as near as Vulkan has it: kernels other than nearest are linear, borders are transparent black.
VkSampler make_sampler(VulkanDevice& device, const CaseRecord& record);

/// Whether two cases can be asked with the same image and sampler.
bool share_sampler(const CaseRecord& a, const CaseRecord& b);

/// Whether the device can be asked with images of this texture at all.
bool can_sample(const VulkanDevice& device, const SuiteTexture& texture);

}  // namespace rawtexel::cli
