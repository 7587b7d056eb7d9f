#include "shading/lookup_policy.h"

namespace rawtexel::shading {
namespace {

/// Sets a member to what its spelling means; false where it means nothing.
template <class T>
PolicyMemberResult set_member(std::optional<T>& member, const std::optional<T>& parsed) {
    if (!parsed) return PolicyMemberResult::UnknownValue;
    member = parsed;
    return PolicyMemberResult::Set;
}

}  // namespace

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

PolicyMemberResult set_policy_member(LookupPolicy& policy, std::string_view name, std::string_view spelling) {
    if (name == "order") return set_member(policy.order, parse_filter_order(spelling));
    if (name == "estimator") return set_member(policy.estimator, texunit::parse_estimator(spelling));
    if (name == "filter") return set_member(policy.filter, texunit::parse_kernel(spelling));
    if (name == "mip") return set_member(policy.mip, texunit::parse_mip_mode(spelling));
    return PolicyMemberResult::UnknownName;
}

std::vector<std::pair<std::string_view, std::string>> policy_members(const LookupPolicy& policy) {
    std::vector<std::pair<std::string_view, std::string>> members;
    if (policy.order) members.emplace_back("order", to_string(*policy.order));
    if (policy.estimator) members.emplace_back("estimator", to_string(*policy.estimator));
    if (policy.filter) members.emplace_back("filter", to_string(*policy.filter));
    if (policy.mip) members.emplace_back("mip", to_string(*policy.mip));
    return members;
}

}  // namespace rawtexel::shading
