// The clusters of a scene's meshes, made once for all its frames.
#pragma once

#include "shading/executor.h"
#include "shading/scene.h"

namespace rawtexel::shading {

/// Fills Mesh::clusters of every mesh that has none.
void cluster_meshes(Scene& scene, Executor& executor);

}  // namespace rawtexel::shading
