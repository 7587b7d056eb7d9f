// The way that the camera of a sequence takes.
#pragma once

#include "cli/sequence_options.h"
#include "cli/view.h"
#include "shading/camera_path.h"

#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// The key frames of a file (docs/frames.md): an array of objects with "eye" and "target", or with a "matrix" of 16 numbers, column by
/// column, that takes the camera to the world; "fov" is in degrees, `fov` where there is none. `path` is for messages. Throws
/// scenes::InputError.
std::vector<shading::CameraKey> parse_camera_keys(const std::string& path, std::string_view json, float fov);

/// Throws UsageError where the way does not fit the view's options or the scene, scenes::InputError for the files of key frames.
shading::CameraPath make_camera_path(const SequenceOptions& sequence, const shading::Scene& scene, const ViewOptions& options,
                                     const View& view);

/// Throws scenes::InputError when the way leads where no image can be made: `what` names it.
void check_camera_path(const shading::CameraPath& path, int frames, const std::string& what);

}  // namespace rawtexel::cli
