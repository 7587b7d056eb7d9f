// What a file says that an image is, against what its bytes are.
#pragma once

#include "scenes/image_codec.h"

#include <string>
#include <string_view>

namespace rawtexel::scenes {

/// Throws InputError "NAME: is JPEG (declared: image/png)" when the first bytes are those of another format than the declared MIME type or,
/// where none is declared, than the extension of `file_name`. Types, extensions and first bytes that name no format claim nothing.
void check_image_claim(const std::string& name, std::string_view mime_type, std::string_view file_name, Bytes encoded);

}  // namespace rawtexel::scenes
