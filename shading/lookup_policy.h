// How the lookups of one material or texture differ from what is asked of all: signed distances and look-up tables, say, whose values mean
// something only when they are filtered first.
#pragma once

#include "shading/filtering_options.h"
#include "texunit/sampler.h"

#include <optional>

namespace rawtexel::shading {

/// Unset members are what the scene and the options of the frame say.
struct LookupPolicy {
    std::optional<FilterOrder> order;  ///< Before without an estimator weighs every tap
    std::optional<texunit::Estimator> estimator;
    std::optional<texunit::Kernel> filter;
    std::optional<texunit::MipMode> mip;

    bool operator==(const LookupPolicy&) const = default;
};

/// `specific` where it says something, else `general`.
LookupPolicy combine(const LookupPolicy& general, const LookupPolicy& specific);

/// `options` as the policy changes them. An order or an estimator of its own takes the place of a baseline.
FilteringOptions apply(const LookupPolicy& policy, FilteringOptions options);

}  // namespace rawtexel::shading
