#ifdef RAWTEXEL_HAS_VULKAN
#include "cli/vulkan/port_dispatch.h"

#include "cli/vulkan/suite_image.h"
#include "cli/vulkan/vulkan_device.h"
#include "scenes/image_io.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <span>

namespace rawtexel::cli {
namespace {

constexpr uint32_t kImages = kBindings - kBufferBindings;

struct PushedRange {
    uint32_t first, count;
};

/// Bindings 0 to 4, as docs/porting.md has them.
class PortBuffers {
  public:
    PortBuffers(VulkanDevice& device, const Suite& suite)
        : device_(device),
          tables_(texture_tables(suite)),
          buffers_{make(suite.cases), make(std::vector<PortResult>(suite.cases.size())), make(tables_.records), make(tables_.texels),
                   make(tables_.words)} {
        for (const size_t n : {0, 1, 2, 4}) check_range(buffers_[n]->size());
    }

    /// Whether a shader sees the texels of all textures at once. Where they are too many for the device it sees those of one.
    bool shows_all_texels() const { return buffers_[kTexels]->size() <= range(); }

    /// Lets a shader see the texels of `texture` alone: their places in the textures' records are counted from the first that it sees.
    void show(uint32_t texture) {
        const VkDeviceSize step = std::max<VkDeviceSize>(device_.properties().limits.minStorageBufferOffsetAlignment, 16);
        const VkDeviceSize first = VkDeviceSize{tables_.records[texture].first_texel[0]} * 16;
        offset_ = first / step * step;
        const VkDeviceSize end = texture + 1 < tables_.records.size() ? VkDeviceSize{tables_.records[texture + 1].first_texel[0]} * 16
                                                                      : buffers_[kTexels]->size();
        check_range(size_t(end - offset_));
        size_ = end - offset_;
        std::vector<TextureRecord> records = tables_.records;
        for (TextureRecord& record : records) {
            for (uint32_t& place : record.first_texel) place -= uint32_t(offset_ / 16);
        }
        std::memcpy(buffers_[kRecords]->data(), records.data(), records.size() * sizeof(TextureRecord));
    }

    VkDescriptorBufferInfo info(uint32_t binding) const {
        if (binding == kTexels) return {buffers_[binding]->handle(), offset_, size_};
        return {buffers_[binding]->handle(), 0, VK_WHOLE_SIZE};
    }
    const std::byte* results() const { return buffers_[kResults]->data(); }

  private:
    static constexpr size_t kResults = 1, kRecords = 2, kTexels = 3;

    size_t range() const { return device_.properties().limits.maxStorageBufferRange; }
    void check_range(size_t bytes) const {
        if (bytes > range())
            throw scenes::InputError("the suite needs a buffer of " + std::to_string(bytes) + " bytes, the device has buffers of " +
                                     std::to_string(range()));
    }
    template <class T>
    std::unique_ptr<VulkanBuffer> make(const std::vector<T>& records) const {
        return std::make_unique<VulkanBuffer>(device_, std::as_bytes(std::span(records)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    }

    VulkanDevice& device_;
    TextureTables tables_;
    std::array<std::unique_ptr<VulkanBuffer>, kBufferBindings> buffers_;
    VkDeviceSize offset_ = 0, size_ = VK_WHOLE_SIZE;  ///< of the texels that are seen
};

/// An image view for each image that a shader asks for; null where it asks for none.
using BoundImages = std::array<VkImageView, kImages>;

/// Images of a suite's textures, made when they are first asked for.
class PortImages {
  public:
    PortImages(VulkanDevice& device, const Suite& suite, const SpirvModule& module) : device_(device), suite_(suite), module_(module) {
        for (uint32_t binding = kBufferBindings; binding < kBindings; ++binding) {
            if (module.bindings.contains(binding))
                blanks_[binding - kBufferBindings] = std::make_unique<SuiteImage>(device, blank_texture(binding));
        }
    }

    /// Whether the device has such images, and the shader a binding for them.
    bool has(uint32_t texture) const {
        const SuiteTexture& asked = suite_.textures[texture];
        return module_.bindings.contains(image_binding(asked.shape())) && can_sample(device_, asked);
    }

    /// Of a texture that there are images of: it and, at bindings of textures of other kinds, blanks.
    BoundImages views(uint32_t texture) {
        BoundImages views{};
        for (size_t n = 0; n < kImages; ++n) {
            if (blanks_[n]) views[n] = blanks_[n]->view();
        }
        std::unique_ptr<SuiteImage>& image = images_[texture];
        if (!image) image = std::make_unique<SuiteImage>(device_, suite_.textures[texture]);
        views[image_binding(suite_.textures[texture].shape()) - kBufferBindings] = image->view();
        return views;
    }

  private:
    VulkanDevice& device_;
    const Suite& suite_;
    const SpirvModule& module_;
    std::array<std::unique_ptr<SuiteImage>, kImages> blanks_;
    std::map<uint32_t, std::unique_ptr<SuiteImage>> images_;
};

/// The shader with its layouts; what was made is destroyed with it.
class PortPipeline {
  public:
    PortPipeline(VulkanDevice& device, const SpirvModule& module, const std::string& path) : device_(device) {
        VkShaderModuleCreateInfo shader_info{};
        shader_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        shader_info.codeSize = module.words.size() * 4;
        shader_info.pCode = module.words.data();
        check(device.vkCreateShaderModule(device.handle(), &shader_info, nullptr, &shader_), "vkCreateShaderModule");
        std::vector<VkDescriptorSetLayoutBinding> bindings;
        for (uint32_t n = 0; n < (module.samples_images() ? kBindings : kBufferBindings); ++n)
            bindings.push_back({n, n < kBufferBindings ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
        VkDescriptorSetLayoutCreateInfo set_info{};
        set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        set_info.bindingCount = uint32_t(bindings.size());
        set_info.pBindings = bindings.data();
        check(device.vkCreateDescriptorSetLayout(device.handle(), &set_info, nullptr, &set_layout_), "vkCreateDescriptorSetLayout");
        const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(PushedRange)};
        VkPipelineLayoutCreateInfo layout_info{};
        layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout_info.setLayoutCount = 1;
        layout_info.pSetLayouts = &set_layout_;
        layout_info.pushConstantRangeCount = 1;
        layout_info.pPushConstantRanges = &range;
        check(device.vkCreatePipelineLayout(device.handle(), &layout_info, nullptr, &layout_), "vkCreatePipelineLayout");
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        info.stage.module = shader_;
        info.stage.pName = module.entry_point.c_str();
        info.layout = layout_;
        if (device.vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_) != VK_SUCCESS)
            throw scenes::InputError(path + ": the device takes it for no compute shader");
    }
    ~PortPipeline() {
        device_.vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
        device_.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
        device_.vkDestroyDescriptorSetLayout(device_.handle(), set_layout_, nullptr);
        device_.vkDestroyShaderModule(device_.handle(), shader_, nullptr);
    }
    PortPipeline(const PortPipeline&) = delete;
    PortPipeline& operator=(const PortPipeline&) = delete;

    /// Runs cases first .. first + count - 1, with these images where the shader asks for some.
    void dispatch(const PortBuffers& buffers, const BoundImages& images, VkSampler sampler, PushedRange range, uint32_t group_size) {
        const std::array<VkDescriptorPoolSize, 2> sizes = {
            {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBufferBindings}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kImages}}};
        VkDescriptorPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        pool_info.maxSets = 1;
        pool_info.poolSizeCount = 2;
        pool_info.pPoolSizes = sizes.data();
        VkDescriptorPool pool = VK_NULL_HANDLE;
        check(device_.vkCreateDescriptorPool(device_.handle(), &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
        VkDescriptorSetAllocateInfo set_info{};
        set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        set_info.descriptorPool = pool;
        set_info.descriptorSetCount = 1;
        set_info.pSetLayouts = &set_layout_;
        VkDescriptorSet set = VK_NULL_HANDLE;
        check(device_.vkAllocateDescriptorSets(device_.handle(), &set_info, &set), "vkAllocateDescriptorSets");

        std::array<VkDescriptorBufferInfo, kBufferBindings> buffer_info{};
        std::array<VkDescriptorImageInfo, kImages> image_info{};
        std::vector<VkWriteDescriptorSet> writes;
        const auto write = [&](uint32_t binding, VkDescriptorType type) -> VkWriteDescriptorSet& {
            VkWriteDescriptorSet one{};
            one.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
            one.dstSet = set;
            one.dstBinding = binding;
            one.descriptorCount = 1;
            one.descriptorType = type;
            return writes.emplace_back(one);
        };
        for (uint32_t n = 0; n < kBufferBindings; ++n) {
            buffer_info[n] = buffers.info(n);
            write(n, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER).pBufferInfo = &buffer_info[n];
        }
        for (uint32_t n = 0; n < kImages; ++n) {
            if (images[n] == VK_NULL_HANDLE) continue;
            image_info[n] = {sampler, images[n], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
            write(kBufferBindings + n, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER).pImageInfo = &image_info[n];
        }
        device_.vkUpdateDescriptorSets(device_.handle(), uint32_t(writes.size()), writes.data(), 0, nullptr);
        device_.run([&](VkCommandBuffer commands) {
            device_.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
            device_.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set, 0, nullptr);
            device_.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(range), &range);
            device_.vkCmdDispatch(commands, (range.count + group_size - 1) / group_size, 1, 1);
            VkMemoryBarrier done{};
            done.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            done.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT, done.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
            device_.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &done, 0,
                                         nullptr, 0, nullptr);
        });
        device_.vkDestroyDescriptorPool(device_.handle(), pool, nullptr);
    }

  private:
    VulkanDevice& device_;
    VkShaderModule shader_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// The texture of a case; cases without one get the first.
uint32_t texture_of(const Suite& suite, const CaseRecord& record) { return record.texture < suite.textures.size() ? record.texture : 0; }

/// One past the last case after `first` that goes with it in one dispatch.
size_t end_of_run(const Suite& suite, size_t first, bool by_sampler) {
    const auto together = [&](const CaseRecord& a, const CaseRecord& b) {
        return by_sampler ? share_sampler(a, b) : texture_of(suite, a) == texture_of(suite, b);
    };
    size_t end = first + 1;
    while (end < suite.cases.size() && together(suite.cases[first], suite.cases[end])) ++end;
    return end;
}

/// A dispatch for each run of cases that one image and one sampler serve, or one texture's texels.
void run_in_parts(VulkanDevice& device, const Suite& suite, PortBuffers& buffers, PortPipeline& pipeline, const SpirvModule& module,
                  std::vector<uint32_t>& unsupported) {
    if (suite.textures.empty()) throw scenes::InputError("the shader samples an image (bindings 5 to 8), but the suite has no textures");
    PortImages images(device, suite, module);
    for (size_t first = 0; first < suite.cases.size();) {
        const CaseRecord& record = suite.cases[first];
        const size_t end = end_of_run(suite, first, module.samples_images());
        const PushedRange range{uint32_t(first), uint32_t(end - first)};
        const uint32_t texture = texture_of(suite, record);
        if (!buffers.shows_all_texels()) buffers.show(texture);
        if (module.samples_images() && !images.has(texture)) {
            if (std::ranges::find(unsupported, texture) == unsupported.end()) unsupported.push_back(texture);
        } else if (module.samples_images()) {
            const VkSampler sampler = make_sampler(device, record);
            pipeline.dispatch(buffers, images.views(texture), sampler, range, module.group_size);
            device.vkDestroySampler(device.handle(), sampler, nullptr);
        } else {
            pipeline.dispatch(buffers, {}, VK_NULL_HANDLE, range, module.group_size);
        }
        first = end;
    }
}

}  // namespace

PortRun dispatch_port(const Suite& suite, const SpirvModule& module, const std::string& path, const std::string& name) {
    VulkanDevice device(name);
    PortBuffers buffers(device, suite);
    PortPipeline pipeline(device, module, path);
    PortRun run{device.description(), std::vector<PortResult>(suite.cases.size()), {}};
    if (module.samples_images() || !buffers.shows_all_texels()) {
        run_in_parts(device, suite, buffers, pipeline, module, run.unsupported);
    } else {
        pipeline.dispatch(buffers, {}, VK_NULL_HANDLE, {0, uint32_t(suite.cases.size())}, module.group_size);
    }
    std::memcpy(run.results.data(), buffers.results(), suite.cases.size() * sizeof(PortResult));
    return run;
}

}  // namespace rawtexel::cli
#endif
