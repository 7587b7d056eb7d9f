#include "scenes/accessor.h"

#include "scenes/message_text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace rawtexel::scenes {
namespace {

uint64_t bytes_of(ComponentType type) {
    switch (type) {
        case ComponentType::Int8:
        case ComponentType::Uint8: return 1;
        case ComponentType::Int16:
        case ComponentType::Uint16: return 2;
        default: return 4;
    }
}

const char* name_of(ComponentType type) {
    switch (type) {
        case ComponentType::Int8: return "signed 8-bit";
        case ComponentType::Uint8: return "unsigned 8-bit";
        case ComponentType::Int16: return "signed 16-bit";
        case ComponentType::Uint16: return "unsigned 16-bit";
        case ComponentType::Uint32: return "unsigned 32-bit";
        default: return "float";
    }
}

struct ElementType {
    const char* name;
    int components, columns;  // columns start on multiples of 4 bytes (3.6.2.4)
};

ElementType element_type(int tinygltf_type) {
    switch (tinygltf_type) {
        case TINYGLTF_TYPE_VEC2: return {"VEC2", 2, 1};
        case TINYGLTF_TYPE_VEC3: return {"VEC3", 3, 1};
        case TINYGLTF_TYPE_VEC4: return {"VEC4", 4, 1};
        case TINYGLTF_TYPE_MAT2: return {"MAT2", 4, 2};
        case TINYGLTF_TYPE_MAT3: return {"MAT3", 9, 3};
        case TINYGLTF_TYPE_MAT4: return {"MAT4", 16, 4};
        default: return {"SCALAR", 1, 1};
    }
}

uint64_t element_bytes(const ElementType& type, ComponentType component) {
    const uint64_t column = bytes_of(component) * uint64_t(type.components / type.columns);
    return type.columns == 1 ? column : uint64_t(type.columns) * ((column + 3) / 4 * 4);
}

/// Buffers promise no alignment.
template <class T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// Normalised integers as 3.6.2.2 defines them.
float load_float(const Accessor& accessor, const std::byte* bytes) {
    const bool fraction = accessor.normalized;
    switch (accessor.component_type) {
        case ComponentType::Int8: return fraction ? std::max(float(load<int8_t>(bytes)) / 127.0f, -1.0f) : float(load<int8_t>(bytes));
        case ComponentType::Uint8: return fraction ? float(load<uint8_t>(bytes)) / 255.0f : float(load<uint8_t>(bytes));
        case ComponentType::Int16: return fraction ? std::max(float(load<int16_t>(bytes)) / 32767.0f, -1.0f) : float(load<int16_t>(bytes));
        case ComponentType::Uint16: return fraction ? float(load<uint16_t>(bytes)) / 65535.0f : float(load<uint16_t>(bytes));
        default: return load<float>(bytes);
    }
}

uint32_t load_unsigned(ComponentType type, const std::byte* bytes) {
    switch (type) {
        case ComponentType::Uint8: return load<uint8_t>(bytes);
        case ComponentType::Uint16: return load<uint16_t>(bytes);
        default: return load<uint32_t>(bytes);
    }
}

uint32_t load_integer(const Accessor& accessor, const std::byte* bytes) { return load_unsigned(accessor.component_type, bytes); }

bool is_unsigned(ComponentType type) {
    return type == ComponentType::Uint8 || type == ComponentType::Uint16 || type == ComponentType::Uint32;
}

std::string name_of(int accessor) { return "accessors[" + std::to_string(accessor) + "]"; }

}  // namespace

Accessors::Accessors(const GltfDocument& document) : document_(document) {
    for (size_t i = 0; i < document.model.accessors.size(); ++i) accessors_.push_back(checked(int(i)));
}

Accessor Accessors::checked(int index) const {
    // Zeros cost nothing in the file: without a view the count is bounded by what the file holds.
    constexpr uint64_t kFreeZeros = 65536;
    const tinygltf::Accessor& source = document_.model.accessors[size_t(index)];
    const ElementType type = element_type(source.type);
    Accessor accessor;
    accessor.index = index;
    accessor.type = type.name;
    accessor.component_type = ComponentType(source.componentType);
    accessor.normalized = source.normalized;
    accessor.components = type.components;
    accessor.count = source.count;
    const uint64_t size = element_bytes(type, accessor.component_type);

    if (source.bufferView < 0) {
        uint64_t held = 0;
        for (const GltfBuffer& buffer : document_.buffers) held += buffer.bytes.size();
        if (accessor.count > held + kFreeZeros)
            document_.fail(name_of(index) + " has " + std::to_string(accessor.count) +
                           " elements without a buffer view, all zero (allowed: " + std::to_string(kFreeZeros) +
                           " and one for each of the file's " + std::to_string(held) + " bytes)");
    } else {
        const std::span<const std::byte> view = document_.view(source.bufferView);
        const uint64_t declared_stride = document_.model.bufferViews[size_t(source.bufferView)].byteStride;
        accessor.stride = declared_stride ? declared_stride : size;
        if (accessor.stride < size)
            document_.fail(name_of(index) + " has elements of " + std::to_string(size) + " bytes at a stride of " +
                           std::to_string(accessor.stride));
        const bool inside = source.byteOffset <= view.size() && size <= view.size() - source.byteOffset &&
                            accessor.count - 1 <= (view.size() - source.byteOffset - size) / accessor.stride;
        if (!inside)
            document_.fail(name_of(index) + " reaches beyond bufferViews[" + std::to_string(source.bufferView) + "] (" +
                           std::to_string(accessor.count) + " elements of " + std::to_string(size) + " bytes at byte " +
                           std::to_string(source.byteOffset) + ", the view has " + std::to_string(view.size()) + " bytes)");
        accessor.base = view.data() + source.byteOffset;
    }
    if (source.sparse.isSparse) check_sparse(accessor, index, size);
    return accessor;
}

void Accessors::check_sparse(Accessor& accessor, int index, uint64_t element_size) const {
    const auto& sparse = document_.model.accessors[size_t(index)].sparse;
    accessor.sparse_count = uint64_t(sparse.count);
    accessor.sparse_index_type = ComponentType(sparse.indices.componentType);
    const auto range = [&](const char* part, int buffer_view, int offset, uint64_t size) {
        const std::span<const std::byte> view = document_.view(buffer_view);
        const uint64_t start = uint64_t(offset);
        if (start > view.size() || accessor.sparse_count > (view.size() - start) / size)
            document_.fail(name_of(index) + ".sparse." + part + " reaches beyond bufferViews[" + std::to_string(buffer_view) + "] (" +
                           std::to_string(accessor.sparse_count) + " elements of " + std::to_string(size) + " bytes at byte " +
                           std::to_string(start) + ", the view has " + std::to_string(view.size()) + " bytes)");
        return view.data() + start;
    };
    accessor.sparse_indices = range("indices", sparse.indices.bufferView, sparse.indices.byteOffset, bytes_of(accessor.sparse_index_type));
    accessor.sparse_values = range("values", sparse.values.bufferView, sparse.values.byteOffset, element_size);

    const std::vector<uint32_t> elements = sparse_elements(accessor);
    for (size_t i = 0; i < elements.size(); ++i) {
        if (elements[i] >= accessor.count)
            document_.fail(name_of(index) + ".sparse.indices holds " + std::to_string(elements[i]) + " (allowed: 0 to " +
                           std::to_string(accessor.count - 1) + ")");
        if (i > 0 && elements[i] <= elements[i - 1])
            document_.fail(name_of(index) + ".sparse.indices holds " + std::to_string(elements[i]) + " after " +
                           std::to_string(elements[i - 1]) + " (they must increase)");
    }
}

std::vector<uint32_t> Accessors::sparse_elements(const Accessor& accessor) const {
    std::vector<uint32_t> elements(accessor.sparse_count);
    const uint64_t size = bytes_of(accessor.sparse_index_type);
    for (size_t i = 0; i < elements.size(); ++i)
        elements[i] = load_unsigned(accessor.sparse_index_type, accessor.sparse_indices + i * size);
    return elements;
}

template <class Component>
std::vector<Component> Accessors::gather(const Accessor& accessor, std::span<const uint32_t> elements,
                                         Component (*load_component)(const Accessor&, const std::byte*)) const {
    const uint64_t size = bytes_of(accessor.component_type), components = uint64_t(accessor.components);
    document_.memory->spend(elements.size() * components * sizeof(Component));
    std::vector<Component> values(elements.size() * components);
    const std::vector<uint32_t> replaced = sparse_elements(accessor);
    size_t next_replaced = 0;
    for (size_t i = 0; i < elements.size(); ++i) {
        const std::byte* element = accessor.base ? accessor.base + elements[i] * accessor.stride : nullptr;
        while (next_replaced < replaced.size() && replaced[next_replaced] < elements[i]) ++next_replaced;
        if (next_replaced < replaced.size() && replaced[next_replaced] == elements[i])
            element = accessor.sparse_values + next_replaced * components * size;
        if (!element) continue;
        for (uint64_t c = 0; c < components; ++c) values[i * components + c] = load_component(accessor, element + c * size);
    }
    return values;
}

std::vector<float> Accessors::read_floats(const Accessor& accessor, std::span<const uint32_t> elements, const AccessorUse& use) const {
    const std::string found = accessor.type + " of " + (accessor.normalized ? "normalized " : "") + name_of(accessor.component_type);
    const bool vector = accessor.type.starts_with("VEC") || accessor.type == "SCALAR" || accessor.type == "MAT4";
    if (!vector || std::ranges::find(use.components, accessor.components) == use.components.end()) {
        std::string allowed;
        for (const int n : use.components) allowed += (allowed.empty() ? "" : ", ") + std::to_string(n);
        document_.fail(use.what + " is " + found + " (allowed: " + allowed + " components)");
    }
    const bool is_float = accessor.component_type == ComponentType::Float;
    const bool small_integer = !is_float && accessor.component_type != ComponentType::Uint32;
    const bool allowed =
        is_float || (small_integer && (use.integers == Integers::Any || (use.integers == Integers::Normalized && accessor.normalized)));
    if (!allowed)
        document_.fail(use.what + " is " + found + " (allowed: float" +
                       (use.integers == Integers::No    ? ""
                        : use.integers == Integers::Any ? ", 8-bit, 16-bit"
                                                        : ", normalized 8-bit, 16-bit") +
                       ")");

    std::vector<float> values = gather<float>(accessor, elements, load_float);
    const auto bad = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
    if (bad != values.end()) {
        const size_t element = size_t(bad - values.begin()) / size_t(accessor.components);
        document_.fail(use.what + " holds " + print_short(*bad) + " at element " + std::to_string(elements[element]) +
                       " (allowed: finite numbers)");
    }
    return values;
}

std::vector<uint32_t> Accessors::read_integers(const Accessor& accessor, std::span<const uint32_t> elements,
                                               const std::string& what) const {
    if (!is_unsigned(accessor.component_type) || accessor.normalized)
        document_.fail(what + " is " + accessor.type + " of " + (accessor.normalized ? "normalized " : "") +
                       name_of(accessor.component_type) + " (allowed: unsigned integers)");
    return gather<uint32_t>(accessor, elements, load_integer);
}

std::vector<uint32_t> Accessors::read_indices(const Accessor& accessor, const std::string& what) const {
    if (accessor.type != "SCALAR") document_.fail(what + " is " + accessor.type + " (allowed: SCALAR)");
    document_.memory->spend(accessor.count * sizeof(uint32_t));
    if (accessor.count > UINT32_MAX) document_.fail(what + " has " + std::to_string(accessor.count) + " elements (allowed: below 2^32)");
    std::vector<uint32_t> all(accessor.count);
    std::iota(all.begin(), all.end(), 0u);
    return read_integers(accessor, all, what);
}

}  // namespace rawtexel::scenes
