// How the lookups of one material or texture differ from what is asked of all: signed distances and look-up tables, say, whose values mean
// something only when they are filtered first.
#pragma once

#include "shading/filtering_options.h"
#include "texunit/sampler.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

// Policies as files have them: members "order", "estimator", "filter" and "mip", spelled as the options of these names take them.

enum class PolicyMemberResult : uint8_t { Set, UnknownName, UnknownValue };
PolicyMemberResult set_policy_member(LookupPolicy& policy, std::string_view name, std::string_view spelling);
/// Name and spelling of every member that is set, in the order above.
std::vector<std::pair<std::string_view, std::string>> policy_members(const LookupPolicy& policy);

}  // namespace rawtexel::shading
