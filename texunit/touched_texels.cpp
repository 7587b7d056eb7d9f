#include "texunit/touched_texels.h"

#include <cassert>

namespace rawtexel::texunit {
namespace {

std::vector<int64_t> lay_out_chunks(std::span<const uint64_t> texels) {
    std::vector<int64_t> first{0};
    for (const uint64_t count : texels) {
        const int64_t chunks = (int64_t(count) + TouchedBits::kTexelsPerChunk - 1) / TouchedBits::kTexelsPerChunk;
        first.push_back(first.back() + (chunks + 63) / 64 * 64);
    }
    return first;
}

}  // namespace

TouchedTexels::TouchedTexels(std::span<const uint64_t> texels)
    : first_chunk_(lay_out_chunks(texels)),
      words_(uint64_t(first_chunk_.back()) * kWordsPerChunk * sizeof(uint32_t)),
      chunks_(uint64_t(first_chunk_.back()) / 64 * sizeof(uint64_t)) {}

TouchedBits TouchedTexels::bits(size_t texture) const {
    return {reinterpret_cast<uint32_t*>(words_.data()) + first_chunk_[texture] * kWordsPerChunk,
            reinterpret_cast<uint64_t*>(chunks_.data()) + first_chunk_[texture] / 64};
}

void TouchedTexels::merge(const TouchedTexels& other) {
    assert(first_chunk_ == other.first_chunk_);
    for (size_t texture = 0; texture < textures(); ++texture) {
        const TouchedBits mine = bits(texture), theirs = other.bits(texture);
        other.for_each_chunk(texture, [&](int64_t chunk) {
            mine.chunks[chunk / 64] |= uint64_t{1} << chunk % 64;
            for (int64_t w = chunk * kWordsPerChunk; w < (chunk + 1) * kWordsPerChunk; ++w) mine.words[w] |= theirs.words[w];
        });
    }
}

}  // namespace rawtexel::texunit
