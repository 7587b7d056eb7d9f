#include "scenes/gltf_schema.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;

enum class Kind {
    Flag,     ///< true or false
    Integer,  ///< within minimum..maximum, and one of `codes` if there are any
    Index,    ///< into the document's array `refers_to`
    Number,
    Text,
    Numbers,  ///< array of numbers, `length` of them if that is not 0
    Indices,  ///< array of indices into `refers_to`
    Texts,
    Object,     ///< by the rules of `object`
    Objects,    ///< array of such
    IndexMap,   ///< object of indices into `refers_to`
    IndexMaps,  ///< array of such
    Extras,     ///< an object by the rules of `object`, left out when it is anything else
};

struct ObjectRules;

struct Property {
    std::string_view name;
    Kind kind = Kind::Flag;
    bool required = false;
    std::string_view refers_to = {};
    const ObjectRules* object = nullptr;
    size_t length = 0;
    double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
    std::span<const int> codes = {};
};

struct ObjectRules {
    std::span<const Property> properties;
};

// glTF 2.0 chapter 5, in the order of its sections; extensions after the core. Sizes stay below 2^53, where every integer is a double.
constexpr double kMaxSize = 9007199254740992.0, kMaxInt = 2147483647.0;
constexpr double kPi = 3.14159265358979323846;

constexpr int kComponentTypes[] = {5120, 5121, 5122, 5123, 5125, 5126};
constexpr int kSparseIndexTypes[] = {5121, 5123, 5125};
constexpr int kFilters[] = {9728, 9729};
constexpr int kMinifications[] = {9728, 9729, 9984, 9985, 9986, 9987};
constexpr int kWraps[] = {33071, 33648, 10497};

constexpr Property kSparseIndices[] = {
    {.name = "bufferView", .kind = Kind::Index, .required = true, .refers_to = "bufferViews"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
    {.name = "componentType", .kind = Kind::Integer, .required = true, .codes = kSparseIndexTypes},
};
constexpr Property kSparseValues[] = {
    {.name = "bufferView", .kind = Kind::Index, .required = true, .refers_to = "bufferViews"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
};
constexpr ObjectRules kSparseIndicesRules{kSparseIndices}, kSparseValuesRules{kSparseValues};
constexpr Property kSparse[] = {
    {.name = "count", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxInt},
    {.name = "indices", .kind = Kind::Object, .required = true, .object = &kSparseIndicesRules},
    {.name = "values", .kind = Kind::Object, .required = true, .object = &kSparseValuesRules},
};
constexpr ObjectRules kSparseRules{kSparse};
constexpr Property kAccessor[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "bufferView", .kind = Kind::Index, .refers_to = "bufferViews"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxSize},
    {.name = "componentType", .kind = Kind::Integer, .required = true, .codes = kComponentTypes},
    {.name = "normalized", .kind = Kind::Flag},
    {.name = "count", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxSize},
    {.name = "type", .kind = Kind::Text, .required = true},
    {.name = "sparse", .kind = Kind::Object, .object = &kSparseRules},
};
constexpr Property kAsset[] = {
    {.name = "version", .kind = Kind::Text, .required = true},
    {.name = "minVersion", .kind = Kind::Text},
};
constexpr Property kBuffer[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "uri", .kind = Kind::Text},
    {.name = "byteLength", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxSize},
};
constexpr Property kBufferView[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "buffer", .kind = Kind::Index, .required = true, .refers_to = "buffers"},
    {.name = "byteOffset", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxSize},
    {.name = "byteLength", .kind = Kind::Integer, .required = true, .minimum = 1, .maximum = kMaxSize},
    {.name = "byteStride", .kind = Kind::Integer, .minimum = 4, .maximum = 252},
};
constexpr Property kOrthographic[] = {
    {.name = "xmag", .kind = Kind::Number, .required = true},
    {.name = "ymag", .kind = Kind::Number, .required = true},
    {.name = "zfar", .kind = Kind::Number, .required = true, .minimum = 0},
    {.name = "znear", .kind = Kind::Number, .required = true, .minimum = 0},
};
constexpr Property kPerspective[] = {
    {.name = "yfov", .kind = Kind::Number, .required = true, .minimum = 1e-6, .maximum = kPi - 1e-6},
    {.name = "znear", .kind = Kind::Number, .required = true, .minimum = std::numeric_limits<float>::min()},
    {.name = "zfar", .kind = Kind::Number, .minimum = std::numeric_limits<float>::min()},
};
constexpr ObjectRules kOrthographicRules{kOrthographic}, kPerspectiveRules{kPerspective};
constexpr Property kCamera[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "type", .kind = Kind::Text, .required = true},
    {.name = "orthographic", .kind = Kind::Object, .object = &kOrthographicRules},
    {.name = "perspective", .kind = Kind::Object, .object = &kPerspectiveRules},
};
constexpr Property kImage[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "uri", .kind = Kind::Text},
    {.name = "mimeType", .kind = Kind::Text},
    {.name = "bufferView", .kind = Kind::Index, .refers_to = "bufferViews"},
};

constexpr Property kTextureTransform[] = {
    {.name = "offset", .kind = Kind::Numbers, .length = 2},
    {.name = "rotation", .kind = Kind::Number},
    {.name = "scale", .kind = Kind::Numbers, .length = 2},
    {.name = "texCoord", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
};
constexpr ObjectRules kTextureTransformRules{kTextureTransform};
constexpr Property kTextureInfoExtensions[] = {
    {.name = "KHR_texture_transform", .kind = Kind::Object, .object = &kTextureTransformRules},
};
constexpr ObjectRules kTextureInfoExtensionsRules{kTextureInfoExtensions};
constexpr Property kTextureInfo[] = {
    {.name = "index", .kind = Kind::Index, .required = true, .refers_to = "textures"},
    {.name = "texCoord", .kind = Kind::Integer, .minimum = 0, .maximum = kMaxInt},
    {.name = "scale", .kind = Kind::Number},
    {.name = "strength", .kind = Kind::Number, .minimum = 0, .maximum = 1},
    {.name = "extensions", .kind = Kind::Object, .object = &kTextureInfoExtensionsRules},
};
constexpr ObjectRules kTextureInfoRules{kTextureInfo};
constexpr Property kMetallicRoughness[] = {
    {.name = "baseColorFactor", .kind = Kind::Numbers, .length = 4, .minimum = 0},
    {.name = "baseColorTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "metallicFactor", .kind = Kind::Number, .minimum = 0, .maximum = 1},
    {.name = "roughnessFactor", .kind = Kind::Number, .minimum = 0, .maximum = 1},
    {.name = "metallicRoughnessTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
};
constexpr ObjectRules kMetallicRoughnessRules{kMetallicRoughness};
constexpr Property kEmissiveStrength[] = {
    {.name = "emissiveStrength", .kind = Kind::Number, .minimum = 0},
};
constexpr ObjectRules kEmissiveStrengthRules{kEmissiveStrength}, kEmptyRules{};
constexpr Property kMaterialExtensions[] = {
    {.name = "KHR_materials_emissive_strength", .kind = Kind::Object, .object = &kEmissiveStrengthRules},
    {.name = "KHR_materials_unlit", .kind = Kind::Object, .object = &kEmptyRules},
};
constexpr ObjectRules kMaterialExtensionsRules{kMaterialExtensions};
constexpr Property kMaterial[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "pbrMetallicRoughness", .kind = Kind::Object, .object = &kMetallicRoughnessRules},
    {.name = "normalTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "occlusionTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "emissiveTexture", .kind = Kind::Object, .object = &kTextureInfoRules},
    {.name = "emissiveFactor", .kind = Kind::Numbers, .length = 3, .minimum = 0},
    {.name = "alphaMode", .kind = Kind::Text},
    {.name = "alphaCutoff", .kind = Kind::Number, .minimum = 0},
    {.name = "doubleSided", .kind = Kind::Flag},
    {.name = "extensions", .kind = Kind::Object, .object = &kMaterialExtensionsRules},
};

constexpr Property kPrimitive[] = {
    {.name = "attributes", .kind = Kind::IndexMap, .required = true, .refers_to = "accessors"},
    {.name = "indices", .kind = Kind::Index, .refers_to = "accessors"},
    {.name = "material", .kind = Kind::Index, .refers_to = "materials"},
    {.name = "mode", .kind = Kind::Integer, .minimum = 0, .maximum = 6},
    {.name = "targets", .kind = Kind::IndexMaps, .refers_to = "accessors"},
};
constexpr ObjectRules kPrimitiveRules{kPrimitive};
constexpr Property kMesh[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "primitives", .kind = Kind::Objects, .required = true, .object = &kPrimitiveRules},
    {.name = "weights", .kind = Kind::Numbers},
};

constexpr Property kNodeLight[] = {
    {.name = "light", .kind = Kind::Index, .required = true, .refers_to = "KHR_lights_punctual"},
};
constexpr ObjectRules kNodeLightRules{kNodeLight};
constexpr Property kNodeExtensions[] = {
    {.name = "KHR_lights_punctual", .kind = Kind::Object, .object = &kNodeLightRules},
};
constexpr ObjectRules kNodeExtensionsRules{kNodeExtensions};
constexpr Property kNode[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "camera", .kind = Kind::Index, .refers_to = "cameras"},
    {.name = "children", .kind = Kind::Indices, .refers_to = "nodes"},
    {.name = "skin", .kind = Kind::Index, .refers_to = "skins"},
    {.name = "matrix", .kind = Kind::Numbers, .length = 16},
    {.name = "mesh", .kind = Kind::Index, .refers_to = "meshes"},
    {.name = "rotation", .kind = Kind::Numbers, .length = 4},
    {.name = "scale", .kind = Kind::Numbers, .length = 3},
    {.name = "translation", .kind = Kind::Numbers, .length = 3},
    {.name = "weights", .kind = Kind::Numbers},
    {.name = "extensions", .kind = Kind::Object, .object = &kNodeExtensionsRules},
};
constexpr Property kSampler[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "magFilter", .kind = Kind::Integer, .codes = kFilters},
    {.name = "minFilter", .kind = Kind::Integer, .codes = kMinifications},
    {.name = "wrapS", .kind = Kind::Integer, .codes = kWraps},
    {.name = "wrapT", .kind = Kind::Integer, .codes = kWraps},
};
constexpr Property kSceneRawtexel[] = {
    {.name = "environment", .kind = Kind::Text},
};
constexpr ObjectRules kSceneRawtexelRules{kSceneRawtexel};
constexpr Property kSceneExtras[] = {
    {.name = "rawtexel", .kind = Kind::Object, .object = &kSceneRawtexelRules},
};
constexpr ObjectRules kSceneExtrasRules{kSceneExtras};
constexpr Property kScene[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "nodes", .kind = Kind::Indices, .refers_to = "nodes"},
    {.name = "extras", .kind = Kind::Extras, .object = &kSceneExtrasRules},
};
constexpr Property kSkin[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "inverseBindMatrices", .kind = Kind::Index, .refers_to = "accessors"},
    {.name = "joints", .kind = Kind::Indices, .required = true, .refers_to = "nodes"},
};
constexpr Property kTextureSource[] = {
    {.name = "source", .kind = Kind::Index, .refers_to = "images"},
};
constexpr ObjectRules kTextureSourceRules{kTextureSource};
constexpr Property kTextureExtensions[] = {
    {.name = "KHR_texture_basisu", .kind = Kind::Object, .object = &kTextureSourceRules},
    {.name = "MSFT_texture_dds", .kind = Kind::Object, .object = &kTextureSourceRules},
};
constexpr ObjectRules kTextureExtensionsRules{kTextureExtensions};
constexpr Property kTexture[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "sampler", .kind = Kind::Index, .refers_to = "samplers"},
    {.name = "source", .kind = Kind::Index, .refers_to = "images"},
    {.name = "extensions", .kind = Kind::Object, .object = &kTextureExtensionsRules},
};

constexpr Property kSpot[] = {
    {.name = "innerConeAngle", .kind = Kind::Number, .minimum = 0, .maximum = kPi / 2},
    {.name = "outerConeAngle", .kind = Kind::Number, .minimum = 0, .maximum = kPi / 2 + 1e-6},
};
constexpr ObjectRules kSpotRules{kSpot};
constexpr Property kLight[] = {
    {.name = "name", .kind = Kind::Text},
    {.name = "color", .kind = Kind::Numbers, .length = 3, .minimum = 0},
    {.name = "intensity", .kind = Kind::Number, .minimum = 0},
    {.name = "type", .kind = Kind::Text, .required = true},
    {.name = "range", .kind = Kind::Number, .minimum = 0},
    {.name = "spot", .kind = Kind::Object, .object = &kSpotRules},
};
constexpr ObjectRules kLightRules{kLight};
constexpr Property kLights[] = {
    {.name = "lights", .kind = Kind::Objects, .required = true, .object = &kLightRules},
};
constexpr ObjectRules kLightsRules{kLights};
constexpr Property kDocumentExtensions[] = {
    {.name = "KHR_lights_punctual", .kind = Kind::Object, .object = &kLightsRules},
};

constexpr ObjectRules kAccessorRules{kAccessor}, kAssetRules{kAsset}, kBufferRules{kBuffer}, kBufferViewRules{kBufferView},
    kCameraRules{kCamera}, kImageRules{kImage}, kMaterialRules{kMaterial}, kMeshRules{kMesh}, kNodeRules{kNode}, kSamplerRules{kSampler},
    kSceneRules{kScene}, kSkinRules{kSkin}, kTextureRules{kTexture}, kDocumentExtensionsRules{kDocumentExtensions};
constexpr Property kDocument[] = {
    {.name = "asset", .kind = Kind::Object, .required = true, .object = &kAssetRules},
    {.name = "extensionsUsed", .kind = Kind::Texts},
    {.name = "extensionsRequired", .kind = Kind::Texts},
    {.name = "accessors", .kind = Kind::Objects, .object = &kAccessorRules},
    {.name = "buffers", .kind = Kind::Objects, .object = &kBufferRules},
    {.name = "bufferViews", .kind = Kind::Objects, .object = &kBufferViewRules},
    {.name = "cameras", .kind = Kind::Objects, .object = &kCameraRules},
    {.name = "images", .kind = Kind::Objects, .object = &kImageRules},
    {.name = "materials", .kind = Kind::Objects, .object = &kMaterialRules},
    {.name = "meshes", .kind = Kind::Objects, .object = &kMeshRules},
    {.name = "nodes", .kind = Kind::Objects, .object = &kNodeRules},
    {.name = "samplers", .kind = Kind::Objects, .object = &kSamplerRules},
    {.name = "scene", .kind = Kind::Index, .refers_to = "scenes"},
    {.name = "scenes", .kind = Kind::Objects, .object = &kSceneRules},
    {.name = "skins", .kind = Kind::Objects, .object = &kSkinRules},
    {.name = "textures", .kind = Kind::Objects, .object = &kTextureRules},
    {.name = "extensions", .kind = Kind::Object, .object = &kDocumentExtensionsRules},
};
constexpr ObjectRules kDocumentRules{kDocument};

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
    constexpr size_t kLongest = 40;
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

[[noreturn]] void reject(const Place& place, const json& value, const std::string& allowed) {
    throw SchemaError((place.parent ? place.text() : "the document") + " is " + shown(value) + " (allowed: " + allowed + ")");
}

std::string range_text(const Property& rule) {
    const auto text = [](double v) { return json(v == std::floor(v) && std::abs(v) <= kMaxSize ? json(int64_t(v)) : json(v)).dump(); };
    if (std::isfinite(rule.minimum) && std::isfinite(rule.maximum)) return " from " + text(rule.minimum) + " to " + text(rule.maximum);
    if (std::isfinite(rule.minimum)) return " from " + text(rule.minimum);
    return "";
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
        return kept;
    }

  private:
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
        // What a float cannot hold would become an infinity further on.
        if (!allowed || std::abs(v.get<double>()) > std::numeric_limits<float>::max()) reject(place, v, "a number" + range_text(rule));
        return v.get<double>();
    }

    /// JSON knows one kind of number: 3.0 is an integer too.
    json integer(const json& v, const Property& rule, const Place& place) const {
        const double number = v.is_number() ? v.get<double>() : 0.5;
        bool allowed = number == std::floor(number) && std::abs(number) <= kMaxSize && number >= rule.minimum && number <= rule.maximum;
        std::string codes;
        bool listed = rule.codes.empty();
        for (const int code : rule.codes) {
            listed = listed || number == code;
            codes += (codes.empty() ? "" : ", ") + std::to_string(code);
        }
        allowed = allowed && listed;
        if (!allowed) reject(place, v, codes.empty() ? "an integer" + range_text(rule) : codes);
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

}  // namespace

json checked_gltf(const json& document) {
    const Place root{nullptr, {}};
    // Version 1 has another shape altogether: its number is the helpful thing to say.
    const auto asset = document.is_object() ? document.find("asset") : document.end();
    if (document.is_object() && asset != document.end() && asset->is_object()) {
        const auto version = asset->find("version");
        const bool text = version != asset->end() && version->is_string();
        if (text && !version->get<std::string>().starts_with("2."))
            throw SchemaError("glTF version " + shown(*version) + " (allowed: 2.x)");
    }
    return Checker(document).object(document, kDocumentRules, root);
}

}  // namespace rawtexel::scenes
