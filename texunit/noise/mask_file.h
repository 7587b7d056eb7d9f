// The file of masks that texunit/noise_table.h reads: how it is made and laid out.
#pragma once

#include "texunit/noise/void_and_cluster.h"

#include <cstddef>
#include <vector>

namespace rawtexel::texunit::noise {

/// Makes all masks, which takes some ten seconds, and packs them.
std::vector<std::byte> make_mask_file();

}  // namespace rawtexel::texunit::noise
