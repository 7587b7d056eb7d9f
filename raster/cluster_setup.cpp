#include "raster/cluster_setup.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/cluster_setup.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "raster/cluster_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

void set_up_lanes(const SetupInputs& inputs, std::span<const VisibleCluster> clusters, uint32_t capacity, SetupBatch& batch) {
    ClusterSetup(inputs, batch).run(clusters, capacity);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rawtexel::raster {

HWY_EXPORT(set_up_lanes);

void set_up_clusters(const SetupInputs& inputs, std::span<const VisibleCluster> clusters, uint32_t capacity, SetupBatch& batch) {
    HWY_DYNAMIC_DISPATCH(set_up_lanes)(inputs, clusters, capacity, batch);
}

}  // namespace rawtexel::raster

#endif  // HWY_ONCE
