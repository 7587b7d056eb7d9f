#include "shading/cluster_meshes.h"

namespace rawtexel::shading {

void cluster_meshes(Scene& scene, Executor& executor) {
    executor.parallel_for(int64_t(scene.meshes.size()), [&](int64_t i, int) {
        Mesh& mesh = scene.meshes[size_t(i)];
        if (!mesh.clusters)
            mesh.clusters = std::make_shared<const raster::MeshClusters>(raster::make_clusters(mesh.positions, mesh.indices));
    });
}

}  // namespace rawtexel::shading
