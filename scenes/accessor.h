// Accessors (glTF 2.0, 3.6): typed elements in buffers, plain, interleaved, normalised or sparse.
#pragma once

#include "scenes/gltf_document.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::scenes {

enum class ComponentType : int { Int8 = 5120, Uint8 = 5121, Int16 = 5122, Uint16 = 5123, Uint32 = 5125, Float = 5126 };

/// One accessor with its ranges checked: every element below `count` may be read.
struct Accessor {
    int index = 0;
    std::string type;  ///< SCALAR, VEC2, …
    ComponentType component_type = ComponentType::Float;
    bool normalized = false;
    int components = 1;
    uint64_t count = 0;
    const std::byte* base = nullptr;  ///< null: zeros
    uint64_t stride = 0;              ///< bytes

    uint64_t sparse_count = 0;
    ComponentType sparse_index_type = ComponentType::Uint32;
    const std::byte* sparse_indices = nullptr;
    const std::byte* sparse_values = nullptr;  ///< tightly packed
};

/// Integer components: none, only as fractions ("normalized"), or also as they are (KHR_mesh_quantization).
enum class Integers { No, Normalized, Any };

/// What an attribute may be.
struct AccessorUse {
    std::string what;             ///< for messages: "meshes[0].primitives[0].attributes.NORMAL"
    std::vector<int> components;  ///< allowed numbers of them
    Integers integers = Integers::No;
};

class Accessors {
  public:
    /// Checks that every accessor of the document lies inside its views, used or not. An accessor without a view is bounded by the size
    /// of the file. Throws InputError.
    explicit Accessors(const GltfDocument& document);

    const Accessor& at(int accessor) const { return accessors_[size_t(accessor)]; }

    /// The elements named by `elements` (ascending, each below count), `components` floats each, all finite.
    std::vector<float> read_floats(const Accessor& accessor, std::span<const uint32_t> elements, const AccessorUse& use) const;

    /// All elements of a SCALAR, or the components of all elements of a VEC4, as unsigned integers (8, 16 or 32 bits, as they are).
    std::vector<uint32_t> read_integers(const Accessor& accessor, std::span<const uint32_t> elements, const std::string& what) const;
    std::vector<uint32_t> read_indices(const Accessor& accessor, const std::string& what) const;

  private:
    Accessor checked(int index) const;
    void check_sparse(Accessor& accessor, int index, uint64_t element_bytes) const;
    template <class Component>
    std::vector<Component> gather(const Accessor& accessor, std::span<const uint32_t> elements,
                                  Component (*load)(const Accessor&, const std::byte*)) const;
    std::vector<uint32_t> sparse_elements(const Accessor& accessor) const;

    const GltfDocument& document_;
    std::vector<Accessor> accessors_;
};

}  // namespace rawtexel::scenes
