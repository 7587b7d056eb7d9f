// Layers that a render makes beside its radiance.
#pragma once

#include <optional>
#include <string_view>

namespace rawtexel::shading {

/// depth: metres along the view axis. normal: the shading normal in the world. albedo: linear base colour. uv: set 0 as the mesh has it.
/// lod: level of detail of the base colour's lookup. material: its index, -1 for none. texels: texel reads per sample. lines: distinct
/// 64-byte lines of decoded texels that the pixel reads. spp: samples. depth, normal, albedo and uv are means over the samples that saw a
/// surface and 0 where none did; lod and material are the first sample's.
enum class Aov { Depth, Normal, Albedo, Uv, Lod, Material, Texels, Lines, Spp };
std::string_view to_string(Aov aov);  // depth normal albedo uv lod material texels lines spp
std::optional<Aov> parse_aov(std::string_view text);

}  // namespace rawtexel::shading
