#include "scenes/gltf_schema.h"

#include "scenes/gltf_schema_rules.h"
#include "scenes/message_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;

/// Where in the document a value stands, written out only when something is wrong with it.
struct Place {
    const Place* parent;
    std::string_view name;      ///< of a member
    size_t element = SIZE_MAX;  ///< of an array

    std::string text() const {
        if (!parent) return "";
        const std::string above = parent->text();
        if (element != SIZE_MAX) return above + "[" + std::to_string(element) + "]";
        return above.empty() ? std::string(name) : above + "." + std::string(name);
    }
};

std::string shown(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return shortened(value.dump());
}

[[noreturn]] void reject(const Place& place, const json& value, const std::string& allowed) {
    throw SchemaError((place.parent ? place.text() : "the document") + " is " + shown(value) + " (allowed: " + allowed + ")");
}

std::string bound_text(double bound) {
    if (bound == kMaxSize) return "2^53";
    if (bound == kMaxInt) return "2^31 - 1";
    return print_short(bound);
}

/// What `rule` allows of a number, in words.
std::string allowed_text(const Property& rule, std::string_view kind) {
    if (!rule.allowed.empty()) return std::string(rule.allowed);
    std::string text;
    for (const Code& code : rule.codes) text += (text.empty() ? "" : ", ") + std::to_string(code.value) + " " + std::string(code.name);
    if (!text.empty()) return text;
    text = kind;
    if (std::isfinite(rule.minimum)) text += " from " + bound_text(rule.minimum);
    if (std::isfinite(rule.maximum)) text += " to " + bound_text(rule.maximum);
    return text;
}

class Checker {
  public:
    explicit Checker(const json& document) : document_(document) {}

    json object(const json& value, const ObjectRules& rules, const Place& place) const {
        if (!value.is_object()) reject(place, value, "an object");
        json kept = json::object();
        for (const Property& property : rules.properties) {
            const auto member = value.find(property.name);
            if (member != value.end()) {
                json checked = this->value(*member, property, {&place, property.name});
                if (!checked.is_null()) kept[std::string(property.name)] = std::move(checked);
            } else if (property.required) {
                const std::string owner = place.parent ? place.text() : "the document";
                throw SchemaError(owner + " has no \"" + std::string(property.name) + "\" (it is required)");
            }
        }
        if (rules.closed) check_closed(value, rules, place);
        return kept;
    }

  private:
    static void check_closed(const json& value, const ObjectRules& rules, const Place& place) {
        std::string names;
        for (const Property& property : rules.properties) names += (names.empty() ? "" : ", ") + std::string(property.name);
        for (const auto& [name, member] : value.items())
            if (std::ranges::find(rules.properties, name, &Property::name) == rules.properties.end())
                throw SchemaError(place.text() + "." + shortened(name) + " is unknown (allowed: " + names + ")");
    }

    json value(const json& v, const Property& rule, const Place& place) const {
        switch (rule.kind) {
            case Kind::Flag: return v.is_boolean() ? v : (reject(place, v, "true or false"), v);
            case Kind::Text: return v.is_string() ? v : (reject(place, v, "a string"), v);
            case Kind::Integer: return integer(v, rule, place);
            case Kind::Index: return index(v, rule, place);
            case Kind::Number: return number(v, rule, place);
            case Kind::Object: return object(v, *rule.object, place);
            case Kind::Extras: return v.is_object() ? extras(v, rule, place) : json();
            case Kind::IndexMap: return index_map(v, rule, place);
            default: return array(v, rule, place);
        }
    }

    json extras(const json& v, const Property& rule, const Place& place) const {
        const auto own = v.find("rawtexel");
        return own == v.end() ? json() : object(v, *rule.object, place);
    }

    json array(const json& v, const Property& rule, const Place& place) const {
        if (!v.is_array() || (rule.length != 0 && v.size() != rule.length))
            reject(place, v, "an array" + (rule.length ? " of " + std::to_string(rule.length) : std::string()));
        json kept = json::array();
        for (size_t i = 0; i < v.size(); ++i) kept.push_back(element(v[i], rule, {&place, {}, i}));
        return kept;
    }

    json element(const json& v, const Property& rule, const Place& place) const {
        switch (rule.kind) {
            case Kind::Numbers: return number(v, rule, place);
            case Kind::Indices: return index(v, rule, place);
            case Kind::Texts: return v.is_string() ? v : (reject(place, v, "a string"), v);
            case Kind::IndexMaps: return index_map(v, rule, place);
            default: return object(v, *rule.object, place);
        }
    }

    json number(const json& v, const Property& rule, const Place& place) const {
        const bool allowed = v.is_number() && v.get<double>() >= rule.minimum && v.get<double>() <= rule.maximum;
        if (!allowed) reject(place, v, allowed_text(rule, "a number"));
        // What a float cannot hold would become an infinity further on.
        if (std::abs(v.get<double>()) > std::numeric_limits<float>::max()) reject(place, v, "a number that a float can hold");
        return v.get<double>();
    }

    /// JSON knows one kind of number: 3.0 is an integer too.
    json integer(const json& v, const Property& rule, const Place& place) const {
        const double number = v.is_number() ? v.get<double>() : 0.5;
        const bool allowed =
            number == std::floor(number) && std::abs(number) <= kMaxSize && number >= rule.minimum && number <= rule.maximum;
        const bool listed = rule.codes.empty() || std::ranges::find(rule.codes, number, &Code::value) != rule.codes.end();
        if (!allowed || !listed) reject(place, v, allowed_text(rule, "an integer"));
        return number < 0 ? json(int64_t(number)) : json(uint64_t(number));
    }

    size_t extent_of(std::string_view array) const {
        const json* list = &document_;
        const auto descend = [&](std::string_view name) {
            if (!list) return;
            const auto member = list->is_object() ? list->find(name) : list->end();
            list = list->is_object() && member != list->end() ? &*member : nullptr;
        };
        if (array == "KHR_lights_punctual") {
            descend("extensions");
            descend(array);
            descend("lights");
        } else {
            descend(array);
        }
        return list && list->is_array() ? list->size() : 0;
    }

    json index(const json& v, const Property& rule, const Place& place) const {
        const size_t extent = extent_of(rule.refers_to);
        const double number = v.is_number() ? v.get<double>() : -1.0;
        if (number != std::floor(number) || number < 0 || number >= double(extent)) {
            const std::string what(rule.refers_to);
            reject(place, v, extent ? "an index of " + what + ", 0 to " + std::to_string(extent - 1) : "no index: there are no " + what);
        }
        return uint64_t(number);
    }

    json index_map(const json& v, const Property& rule, const Place& place) const {
        if (!v.is_object()) reject(place, v, "an object");
        json kept = json::object();
        for (const auto& [name, target] : v.items()) kept[name] = index(target, rule, {&place, name});
        return kept;
    }

    const json& document_;
};

/// Of the specification (glTF 2.0, 3.2).
struct Version {
    int major = 0, minor = 0;
    auto operator<=>(const Version&) const = default;
};
constexpr Version kSupported{2, 0};

/// "MAJOR.MINOR".
std::optional<Version> parse_version(std::string_view text) {
    Version version;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.') return std::nullopt;
    const auto minor = std::from_chars(major.ptr + 1, end, version.minor);
    if (minor.ec != std::errc() || minor.ptr != end || version.major < 0 || version.minor < 0) return std::nullopt;
    return version;
}

/// Version 1 has another shape altogether: its number is the helpful thing to say, before anything else is looked at.
void check_version(const json& document) {
    const auto asset = document.is_object() ? document.find("asset") : document.end();
    if (!document.is_object() || asset == document.end() || !asset->is_object()) return;
    const auto read = [&](const char* name) -> std::optional<Version> {
        const auto member = asset->find(name);
        if (member == asset->end() || !member->is_string()) return std::nullopt;
        const auto version = parse_version(member->get_ref<const std::string&>());
        if (!version)
            throw SchemaError("asset." + std::string(name) + " is " + shown(*member) + " (allowed: two numbers, such as \"2.0\")");
        return version;
    };
    const std::optional<Version> version = read("version"), least = read("minVersion");
    if (version && version->major != kSupported.major) throw SchemaError("glTF version " + shown((*asset)["version"]) + " (allowed: 2.x)");
    if (least && *least > kSupported)
        throw SchemaError("asset.minVersion is " + shown((*asset)["minVersion"]) + " (allowed: at most \"2.0\")");
}

}  // namespace

json checked_gltf(const json& document, const SchemaOptions& options) {
    check_version(document);
    const Place root{nullptr, {}};
    const Checker checker(document);
    json checked = checker.object(document, kDocumentRules, root);
    if (options.animations) checked.update(checker.object(document, kAnimationRules, root));
    return checked;
}

}  // namespace rawtexel::scenes
