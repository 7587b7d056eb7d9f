#include "scenes/export_buffer.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;  // glTF 2.0, 3.6.2.2

template <class Vector>
json components(const Vector& v) {
    json array = json::array();
    for (int c = 0; c < int(Vector::length()); ++c) array.push_back(double(v[c]));
    return array;
}

}  // namespace

std::optional<int> ExportBuffer::known_view(size_t hash, std::span<const std::byte> bytes) const {
    const auto [begin, end] = view_by_hash_.equal_range(hash);
    for (auto entry = begin; entry != end; ++entry) {
        const json& view = views_[size_t(entry->second)];
        if (view["byteLength"].get<size_t>() == bytes.size() &&
            std::memcmp(bytes_.data() + view["byteOffset"].get<size_t>(), bytes.data(), bytes.size()) == 0)
            return entry->second;
    }
    return std::nullopt;
}

int ExportBuffer::add_view(std::span<const std::byte> bytes) {
    const size_t hash = std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (const auto known = known_view(hash, bytes)) return *known;
    const int index = int(views_.size());
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    view_by_hash_.emplace(hash, index);
    return index;
}

int ExportBuffer::add_accessor(json accessor) {
    // Equal bytes of another type, or without bounds, are another accessor of the same view.
    const auto [entry, is_new] = accessor_by_view_.try_emplace(accessor["bufferView"].get<int>(), int(accessors_.size()));
    if (!is_new && accessors_[size_t(entry->second)] == accessor) return entry->second;
    accessors_.push_back(std::move(accessor));
    return int(accessors_.size()) - 1;
}

template <class Vector>
int ExportBuffer::add_vectors(std::span<const Vector> values, bool with_bounds) {
    json accessor = {{"bufferView", add_view(std::as_bytes(values))},
                     {"componentType", kFloat},
                     {"count", values.size()},
                     {"type", "VEC" + std::to_string(Vector::length())}};
    if (with_bounds) {
        Vector lower = values.front(), upper = lower;
        for (const Vector& value : values) {
            lower = glm::min(lower, value);
            upper = glm::max(upper, value);
        }
        accessor["min"] = components(lower);
        accessor["max"] = components(upper);
    }
    return add_accessor(std::move(accessor));
}

template int ExportBuffer::add_vectors(std::span<const glm::vec2>, bool);
template int ExportBuffer::add_vectors(std::span<const glm::vec3>, bool);
template int ExportBuffer::add_vectors(std::span<const glm::vec4>, bool);

int ExportBuffer::add_indices(std::span<const uint32_t> indices) {
    return add_accessor(
        {{"bufferView", add_view(std::as_bytes(indices))}, {"componentType", kUnsignedInt}, {"count", indices.size()}, {"type", "SCALAR"}});
}

}  // namespace rawtexel::scenes
