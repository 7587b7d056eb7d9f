// The binary chunk of an exported file: accessors and images packed one after the other, equal ones stored once.
#pragma once

#include <nlohmann/json.hpp>

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace rawtexel::scenes {

class ExportBuffer {
  public:
    /// Index of the buffer view that holds `bytes`, 4-byte aligned.
    int add_view(std::span<const std::byte> bytes);

    /// Index of an accessor of floats; Vector is glm::vec2, vec3 or vec4. `with_bounds` writes min and max, as positions need.
    template <class Vector>
    int add_vectors(std::span<const Vector> values, bool with_bounds = false);
    int add_indices(std::span<const uint32_t> indices);

    const nlohmann::json& views() const { return views_; }
    const nlohmann::json& accessors() const { return accessors_; }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    int add_accessor(nlohmann::json accessor);
    std::optional<int> known_view(size_t hash, std::span<const std::byte> bytes) const;

    std::vector<std::byte> bytes_;
    nlohmann::json views_ = nlohmann::json::array(), accessors_ = nlohmann::json::array();
    std::unordered_multimap<size_t, int> view_by_hash_;
    std::unordered_map<int, int> accessor_by_view_;
};

extern template int ExportBuffer::add_vectors(std::span<const glm::vec2>, bool);
extern template int ExportBuffer::add_vectors(std::span<const glm::vec3>, bool);
extern template int ExportBuffer::add_vectors(std::span<const glm::vec4>, bool);

}  // namespace rawtexel::scenes
