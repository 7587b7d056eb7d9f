// PNG files written chunk by chunk, for what no encoder would write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace rawtexel::scenes {

class PngParts {
  public:
    PngParts() {
        for (const char c : std::string_view("\x89PNG\r\n\x1a\n")) bytes_.push_back(std::byte(c));
    }
    void header(uint32_t width, uint32_t height, uint8_t bits, uint8_t colour_type) {
        std::vector<uint8_t> data;
        append_32(data, width);
        append_32(data, height);
        data.insert(data.end(), {bits, colour_type, 0, 0, 0});
        chunk("IHDR", data);
    }
    void chunk(std::string_view type, const std::vector<uint8_t>& data) {
        std::vector<uint8_t> summed(type.begin(), type.end()), out;
        summed.insert(summed.end(), data.begin(), data.end());
        append_32(out, uint32_t(data.size()));
        out.insert(out.end(), summed.begin(), summed.end());
        append_32(out, checksum(summed));
        for (const uint8_t b : out) bytes_.push_back(std::byte(b));
    }
    /// Filter bytes and samples of all rows, at most 65535 bytes: one stored block (RFC 1950 and 1951).
    void pixels(const std::vector<uint8_t>& rows) {
        const auto length = uint16_t(rows.size());
        const auto low = uint8_t(length & 0xff), high = uint8_t(length / 256);
        std::vector<uint8_t> data = {0x78, 0x01, 1, low, high, uint8_t(~low), uint8_t(~high)};
        data.insert(data.end(), rows.begin(), rows.end());
        uint32_t a = 1, b = 0;  // Adler-32
        for (const uint8_t byte : rows) {
            a = (a + byte) % 65521;
            b = (b + a) % 65521;
        }
        append_32(data, b << 16 | a);
        chunk("IDAT", data);
    }
    void end() { chunk("IEND", {}); }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    static void append_32(std::vector<uint8_t>& out, uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) out.push_back(uint8_t(value >> shift & 0xff));
    }
    /// CRC-32, a bit at a time.
    static uint32_t checksum(const std::vector<uint8_t>& data) {
        uint32_t crc = ~0u;
        for (const uint8_t byte : data) {
            crc ^= byte;
            for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
        }
        return ~crc;
    }

    std::vector<std::byte> bytes_;
};

}  // namespace rawtexel::scenes
