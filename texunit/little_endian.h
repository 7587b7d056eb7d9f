// Little-endian numbers from memory of any alignment.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>

namespace rawtexel::texunit {

static_assert(std::endian::native == std::endian::little, "blocks and containers are little-endian and are read as they are");

template <class T>
inline T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

}  // namespace rawtexel::texunit
