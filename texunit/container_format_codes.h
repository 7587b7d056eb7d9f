// The format numbers that containers carry: DXGI_FORMAT in DDS, VkFormat in KTX2.
#pragma once

#include "texunit/container_texel.h"

#include <cstdint>
#include <optional>
#include <string>

namespace rawtexel::texunit {

/// What a DXGI_FORMAT or a VkFormat stores; nullopt for those that are not read.
std::optional<FileTexel> dxgi_texel(uint32_t dxgi_format);
std::optional<FileTexel> vulkan_texel(uint32_t vk_format);

/// Number and, where a file may well hold it, name and reason, for messages about those that are not read.
std::string describe_dxgi(uint32_t dxgi_format);
std::string describe_vulkan(uint32_t vk_format);

}  // namespace rawtexel::texunit
