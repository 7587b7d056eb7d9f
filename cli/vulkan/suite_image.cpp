#ifdef RAWTEXEL_HAS_VULKAN
#include "cli/vulkan/suite_image.h"

#include "scenes/image_io.h"

#include <algorithm>
#include <array>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using texunit::Shape;

VkFormat vulkan_format(Format format) {
    switch (format) {
        case Format::RGBA8Unorm: return VK_FORMAT_R8G8B8A8_UNORM;
        case Format::RGBA8Srgb: return VK_FORMAT_R8G8B8A8_SRGB;
        case Format::RGBA32Float: return VK_FORMAT_R32G32B32A32_SFLOAT;
        case Format::BC1RgbUnorm: return VK_FORMAT_BC1_RGB_UNORM_BLOCK;
        case Format::BC1RgbaUnorm: return VK_FORMAT_BC1_RGBA_UNORM_BLOCK;
        case Format::BC2Unorm: return VK_FORMAT_BC2_UNORM_BLOCK;
        case Format::BC3Unorm: return VK_FORMAT_BC3_UNORM_BLOCK;
        case Format::BC4Unorm: return VK_FORMAT_BC4_UNORM_BLOCK;
        case Format::BC4Snorm: return VK_FORMAT_BC4_SNORM_BLOCK;
        case Format::BC5Unorm: return VK_FORMAT_BC5_UNORM_BLOCK;
        case Format::BC5Snorm: return VK_FORMAT_BC5_SNORM_BLOCK;
        case Format::BC6HUfloat: return VK_FORMAT_BC6H_UFLOAT_BLOCK;
        case Format::BC6HSfloat: return VK_FORMAT_BC6H_SFLOAT_BLOCK;
        case Format::BC7Unorm: return VK_FORMAT_BC7_UNORM_BLOCK;
        case Format::BC7Srgb: return VK_FORMAT_BC7_SRGB_BLOCK;
        default: return VK_FORMAT_UNDEFINED;
    }
}

VkSamplerAddressMode address_mode(uint32_t wrap) {
    static constexpr VkSamplerAddressMode kModes[] = {VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
                                                      VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER,
                                                      VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    return kModes[std::min<size_t>(wrap, 4)];
}

VkFilter filter_of(uint32_t kernel) { return kernel == 0 ? VK_FILTER_NEAREST : VK_FILTER_LINEAR; }

VkImageMemoryBarrier barrier(VkImage image, VkImageLayout from, VkImageLayout to, VkAccessFlags before, VkAccessFlags after) {
    VkImageMemoryBarrier change{};
    change.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    change.srcAccessMask = before, change.dstAccessMask = after;
    change.oldLayout = from, change.newLayout = to;
    change.srcQueueFamilyIndex = change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    change.image = image;
    change.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    return change;
}

}  // namespace

uint32_t image_binding(const Shape& shape) {
    if (shape.cube) return kCubeBinding;
    if (shape.depth > 1) return kVolumeBinding;
    return shape.layers > 1 ? kArrayBinding : kFlatBinding;
}

SuiteTexture blank_texture(uint32_t binding) {
    Shape shape;
    if (binding == kArrayBinding) shape.layers = 2;
    if (binding == kCubeBinding) shape.layers = 6, shape.cube = true;
    if (binding == kVolumeBinding) shape.depth = 2, shape.levels = 2;
    const size_t texels = binding == kVolumeBinding ? 3 : size_t(shape.layers);
    return {"blank", Format::RGBA8Unorm, shape, std::vector<std::byte>(4 * texels)};
}

bool can_sample(const VulkanDevice& device, const SuiteTexture& texture) {
    const VkFormat format = vulkan_format(texture.format());
    const Shape& shape = texture.shape();
    const bool compressed = texunit::info(texture.format()).block_compressed;
    // Arrays of cube maps and compressed volumes are features of their own, which no suite asks for.
    if ((shape.cube && shape.cubes() > 1) || (compressed && shape.depth > 1)) return false;
    return format != VK_FORMAT_UNDEFINED && device.samples(format) && (!compressed || device.features().textureCompressionBC != 0);
}

SuiteImage::SuiteImage(VulkanDevice& device, const SuiteTexture& texture) : device_(device) {
    const Shape& shape = texture.shape();
    if (!can_sample(device, texture))
        throw scenes::InputError("the device samples no images such as texture '" + texture.name() + "' (" +
                                 std::string(texunit::info(texture.format()).name) + "), which the shader asks for");
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = shape.cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    info.imageType = shape.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = vulkan_format(texture.format());
    info.extent = {uint32_t(shape.width), uint32_t(shape.height), uint32_t(shape.depth)};
    info.mipLevels = uint32_t(shape.levels);
    info.arrayLayers = uint32_t(shape.layers);
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    check(device.vkCreateImage(device.handle(), &info, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements needs;
    device.vkGetImageMemoryRequirements(device.handle(), image_, &needs);
    memory_ = device.allocate(needs, 0);
    check(device.vkBindImageMemory(device.handle(), image_, memory_, 0), "vkBindImageMemory");
    upload(texture);
    make_view(image_binding(shape), info.format);
}

void SuiteImage::upload(const SuiteTexture& texture) {
    const Shape& shape = texture.shape();
    const VulkanBuffer staging(device_, texture.bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::vector<VkBufferImageCopy> copies;
    VkDeviceSize at = 0;
    for (int level = 0; level < shape.levels; ++level) {
        const int width = texunit::level_extent(shape.width, level), height = texunit::level_extent(shape.height, level);
        VkBufferImageCopy copy{};
        copy.bufferOffset = at;
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, uint32_t(level), 0, uint32_t(shape.layers)};
        copy.imageExtent = {uint32_t(width), uint32_t(height), uint32_t(texunit::level_extent(shape.depth, level))};
        copies.push_back(copy);
        at += texunit::stored_bytes(texture.format(), width, height) * VkDeviceSize(slice_count(shape, level));
    }
    device_.run([&](VkCommandBuffer commands) {
        const auto to_copy =
            barrier(image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0, VK_ACCESS_TRANSFER_WRITE_BIT);
        device_.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr,
                                     1, &to_copy);
        device_.vkCmdCopyBufferToImage(commands, staging.handle(), image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, uint32_t(copies.size()),
                                       copies.data());
        const auto to_read = barrier(image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                     VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT);
        device_.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 0, nullptr, 0,
                                     nullptr, 1, &to_read);
    });
}

void SuiteImage::make_view(uint32_t binding, VkFormat format) {
    static constexpr VkImageViewType kTypes[] = {VK_IMAGE_VIEW_TYPE_2D, VK_IMAGE_VIEW_TYPE_2D_ARRAY, VK_IMAGE_VIEW_TYPE_CUBE,
                                                 VK_IMAGE_VIEW_TYPE_3D};
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image_;
    info.viewType = kTypes[binding - kFlatBinding];
    info.format = format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    check(device_.vkCreateImageView(device_.handle(), &info, nullptr, &view_), "vkCreateImageView");
}

SuiteImage::~SuiteImage() {
    device_.vkDestroyImageView(device_.handle(), view_, nullptr);
    device_.vkDestroyImage(device_.handle(), image_, nullptr);
    device_.vkFreeMemory(device_.handle(), memory_, nullptr);
}

VkSampler make_sampler(VulkanDevice& device, const CaseRecord& record) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = filter_of(record.magnify);
    info.minFilter = filter_of(record.minify);
    info.mipmapMode = record.mip == 2 ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = address_mode(record.wrap_s);
    info.addressModeV = address_mode(record.wrap_t);
    info.addressModeW = address_mode(record.wrap_r);
    info.mipLodBias = record.lod_bias;
    info.anisotropyEnable = record.probes > 1 && device.features().samplerAnisotropy != 0;
    info.maxAnisotropy = std::min(float(record.probes), device.properties().limits.maxSamplerAnisotropy);
    info.minLod = record.min_lod;
    // No levels: as the specification advises, a quarter keeps minification and magnification apart.
    info.maxLod = record.mip == 0 ? 0.25f : record.max_lod;
    if (record.mip == 0) info.minLod = 0;
    info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
    VkSampler sampler = VK_NULL_HANDLE;
    check(device.vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return sampler;
}

bool share_sampler(const CaseRecord& a, const CaseRecord& b) {
    const auto state = [](const CaseRecord& r) {
        return std::array{float(r.texture), float(r.magnify), float(r.minify), float(r.mip), float(r.wrap_s), float(r.wrap_t),
                          float(r.wrap_r),  r.lod_bias,       float(r.probes), r.min_lod,    r.max_lod};
    };
    return state(a) == state(b);
}

}  // namespace rawtexel::cli
#endif
