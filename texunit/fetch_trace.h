// The canonical fetch stream as a file: zstd-compressed records, one for each texel read (docs/fetches.md).
#pragma once

#include "texunit/texel_addresses.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace rawtexel::texunit {

inline constexpr std::string_view kTraceMagic = "RAWTEXT1";

/// As the file has it, little-endian, without gaps.
struct TraceRecord {
    uint16_t pixel_x, pixel_y;
    uint32_t sample;
    uint32_t texture;  ///< in the order of the header's names
    uint8_t level;
    uint8_t bytes_decoded;  ///< of the texel
    uint8_t bytes_stored;   ///< of the file's unit that holds it: a block or a texel
    uint8_t zero;
    uint16_t x, y, z;  ///< texel; z is the array layer, 6*cube + face, or the depth slice
    uint16_t zeroes;
    uint64_t stored, decoded;  ///< byte addresses
};
static_assert(sizeof(TraceRecord) == 40);

/// Writes header and records through `write`, which gets the compressed bytes in order and may throw.
class FetchTraceWriter {
  public:
    using Write = std::function<void(std::span<const std::byte>)>;
    explicit FetchTraceWriter(Write write);
    ~FetchTraceWriter();
    FetchTraceWriter(const FetchTraceWriter&) = delete;
    FetchTraceWriter& operator=(const FetchTraceWriter&) = delete;

    /// Once, before any record.
    void begin(std::span<const Texture* const> textures);
    void add(const FetchStream& stream, const TexelAddresses& addresses);
    /// Once, after all records.
    void end();

  private:
    struct Compressor;
    void put(std::span<const std::byte> bytes);
    std::unique_ptr<Compressor> compressor_;
    Write write_;
    std::vector<TraceRecord> records_;
};

}  // namespace rawtexel::texunit
