#include "shading/lookup_policy.h"

namespace rawtexel::shading {

LookupPolicy combine(const LookupPolicy& general, const LookupPolicy& specific) {
    LookupPolicy combined = specific;
    // An order comes with its estimator: another policy's says nothing about it.
    if (!specific.order) {
        combined.order = general.order;
        if (!specific.estimator) combined.estimator = general.estimator;
    }
    if (!specific.filter) combined.filter = general.filter;
    if (!specific.mip) combined.mip = general.mip;
    return combined;
}

FilteringOptions apply(const LookupPolicy& policy, FilteringOptions options) {
    if (policy.order || policy.estimator) options.baseline = Baseline::None;
    if (policy.order) {
        options.order = policy.order;
        if (*policy.order == FilterOrder::Before) options.estimator = texunit::Estimator::All;
    } else if (policy.estimator) {
        options.order = std::nullopt;
    }
    if (policy.estimator) options.estimator = *policy.estimator;
    return options;
}

}  // namespace rawtexel::shading
