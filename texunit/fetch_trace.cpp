#include "texunit/fetch_trace.h"

#include <zstd.h>

#include <bit>
#include <new>
#include <stdexcept>
#include <string>

namespace rawtexel::texunit {
namespace {

static_assert(std::endian::native == std::endian::little, "records are written as they lie in memory");

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

TraceRecord record_of(const PixelFetches& pixel, TexelFetch fetch, const TexelAddresses& addresses) {
    const TexelAddresses::Position at = addresses.position(fetch);
    TraceRecord record{};
    record.pixel_x = pixel.x, record.pixel_y = pixel.y;
    record.sample = pixel.sample;
    record.texture = fetch.texture();
    record.level = uint8_t(fetch.level());
    record.bytes_decoded = uint8_t(addresses.bytes_per_texel(fetch));
    record.bytes_stored = uint8_t(addresses.bytes_per_unit(fetch));
    record.x = uint16_t(at.x), record.y = uint16_t(at.y), record.z = uint16_t(at.slice);
    record.stored = addresses.stored(fetch, at);
    record.decoded = addresses.decoded(fetch);
    return record;
}

}  // namespace

struct FetchTraceWriter::Compressor {
    Compressor() : context(ZSTD_createCCtx()), out(ZSTD_CStreamOutSize()) {
        if (context == nullptr) throw std::bad_alloc();
        ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, 3);
        ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
    }
    ~Compressor() { ZSTD_freeCCtx(context); }
    Compressor(const Compressor&) = delete;
    Compressor& operator=(const Compressor&) = delete;

    void run(std::span<const std::byte> bytes, ZSTD_EndDirective directive, const Write& write) {
        ZSTD_inBuffer input{bytes.data(), bytes.size(), 0};
        for (bool done = false; !done;) {
            ZSTD_outBuffer output{out.data(), out.size(), 0};
            const size_t remaining = ZSTD_compressStream2(context, &output, &input, directive);
            if (ZSTD_isError(remaining)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(remaining));
            if (output.pos > 0) write(std::span(out).first(output.pos));
            done = directive == ZSTD_e_end ? remaining == 0 : input.pos == input.size;
        }
    }

    ZSTD_CCtx* context;
    std::vector<std::byte> out;
};

FetchTraceWriter::FetchTraceWriter(Write write) : compressor_(std::make_unique<Compressor>()), write_(std::move(write)) {}
FetchTraceWriter::~FetchTraceWriter() = default;

void FetchTraceWriter::begin(std::span<const Texture* const> textures) {
    put(bytes_of(kTraceMagic));
    put(bytes_of(uint32_t(textures.size())));
    for (const Texture* texture : textures) {
        put(bytes_of(uint32_t(texture->name().size())));
        put(bytes_of(std::string_view(texture->name())));
    }
}

void FetchTraceWriter::add(const FetchStream& stream, const TexelAddresses& addresses) {
    records_.clear();
    auto fetch = stream.fetches.begin();
    for (const PixelFetches& pixel : stream.pixels) {
        for (uint32_t n = 0; n < pixel.count; ++n) records_.push_back(record_of(pixel, *fetch++, addresses));
    }
    put(std::as_bytes(std::span(records_)));
}

void FetchTraceWriter::end() { compressor_->run({}, ZSTD_e_end, write_); }

void FetchTraceWriter::put(std::span<const std::byte> bytes) { compressor_->run(bytes, ZSTD_e_continue, write_); }

}  // namespace rawtexel::texunit
