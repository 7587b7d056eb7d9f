// A suite of the lookups that a scene makes: what a user's own shader is asked on a frame of theirs.
#pragma once

#include "cli/vectors/suite.h"
#include "shading/lighting.h"
#include "shading/render.h"

#include <string>

namespace rawtexel::cli {

inline constexpr size_t kMostSceneCases = 1 << 20;
inline constexpr uint64_t kMostSceneTexels = uint64_t{1} << 30;  ///< bytes of all textures as floats

/// Looks on while the first sample of the frame is rendered and keeps `cases` of its lookups, spread over all of it by a hash of pixel and
/// map, in the order of pixels; the same ones every time. A group a map. Where the options' estimator draws, each case is a draw with the
/// numbers of its pixel. Lookups whose texel lies within a port's freedom are left out and counted. Throws scenes::InputError where there
/// are no lookups, or textures need more than kMostSceneTexels.
Suite make_scene_suite(const std::string& name, const shading::Scene& scene, const shading::Lighting& lighting,
                       const shading::RenderOptions& options, size_t cases);

}  // namespace rawtexel::cli
