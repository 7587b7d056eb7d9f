#include "texunit/containers.h"

#include <algorithm>
#include <array>

namespace rawtexel::texunit {
namespace {

constexpr std::array<unsigned char, 4> kDdsMagic = {'D', 'D', 'S', ' '};
constexpr std::array<unsigned char, 12> kKtx2Magic = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};

bool begins_with(const ByteSource& bytes, std::span<const unsigned char> magic) {
    std::array<std::byte, 12> first;
    if (bytes.size() < magic.size()) return false;
    bytes.read(0, std::span(first).first(magic.size()));
    return std::equal(magic.begin(), magic.end(), first.begin(), [](unsigned char m, std::byte b) { return std::byte{m} == b; });
}

}  // namespace

ContainerKind container_kind(const ByteSource& bytes) {
    if (begins_with(bytes, kDdsMagic)) return ContainerKind::Dds;
    if (begins_with(bytes, kKtx2Magic)) return ContainerKind::Ktx2;
    return ContainerKind::None;
}

}  // namespace rawtexel::texunit
