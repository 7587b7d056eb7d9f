// Texels as they are, written to image files.
#pragma once

#include "scenes/image_io.h"
#include "texunit/texture.h"

#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Throws UsageError where the image format named by the extension of `path` cannot hold texels of `format`: those of signed formats and of
/// floats need a format of signed floats with alpha.
void check_holds_texels(std::string_view option, const std::string& path, texunit::Format format);

/// Whether texels of the slice have an alpha other than 1 that the image format has no place for.
bool loses_alpha(const std::string& path, texunit::Texture& texture, int level, int slice);

/// Writes one slice (array layer, 6*cube + face, or depth slice) of one level. Formats of floats get linear values, 8-bit ones the
/// texture's own codes: sRGB-encoded where the texture is, and rounded to the nearest where a code has more than 8 bits; PNG takes formats
/// of 16 bits whole. One channel is written as grey, two as red and green with blue 0; alpha stays unassociated.
/// Throws texunit::TextureError and scenes::OutputError.
void write_slice(const std::string& path, texunit::Texture& texture, int level, int slice, const scenes::Metadata& metadata);

}  // namespace rawtexel::cli
