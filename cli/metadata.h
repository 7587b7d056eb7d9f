// What an image file says about how it was made.
#pragma once

#include "cli/run_record.h"
#include "scenes/image_io.h"

namespace rawtexel::cli {

/// Command, version, scene, seed, samples, pixel filter, camera, texture filter and, when counted, fetch totals.
scenes::Metadata image_metadata(const RunRecord& record);

}  // namespace rawtexel::cli
