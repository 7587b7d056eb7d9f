// What an image file says about how it was made.
#pragma once

#include "cli/run_record.h"
#include "scenes/image_io.h"

namespace rawtexel::cli {

/// Command, version, scene, crop, seed, samples, pixel filter and jitter, camera, of a sequence its frames, every choice of lookups;
/// exposure, tone map and transfer where the format `has_display_transform`; fetch totals when they were counted.
scenes::Metadata image_metadata(const RunRecord& record, bool has_display_transform);

}  // namespace rawtexel::cli
