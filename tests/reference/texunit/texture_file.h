// DDS and KTX2 files read the slow way: one texel at a time, in double precision. Knows the formats of the files we test with, trusts
// what they say, and shares no code with the library but zstd.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rawtexel::reference {

class TextureFile {
  public:
    explicit TextureFile(std::vector<std::byte> bytes);

    bool known() const { return kind_ != Kind::Unknown; }
    int width(int level) const { return std::max(1, width_ >> level); }
    int height(int level) const { return std::max(1, height_ >> level); }
    int levels() const { return levels_; }
    int layers() const { return layers_; }

    /// Linear red, green, blue, alpha.
    std::array<double, 4> value(int level, int layer, int x, int y) const;

  private:
    enum class Kind { Unknown, Bc1Rgb, Bc1Rgba, Bc2, Bc3, Rxgb, Bc4, Bc5, Bc6hUfloat, Bc6hSfloat, Bc7, Masks, Half4, Float4 };

    void read_dds();
    void read_ktx2();
    void set_dxgi(uint32_t format);
    void set_masks(int unit_bytes, const std::array<uint32_t, 4>& mask);
    uint32_t word(size_t at) const;
    size_t level_bytes(int level) const;
    const std::byte* unit(int level, int layer, int x, int y) const;
    std::array<double, 4> encoded(int level, int layer, int x, int y) const;

    std::vector<std::byte> bytes_;
    Kind kind_ = Kind::Unknown;
    bool srgb_ = false;
    int width_ = 0, height_ = 0, levels_ = 1, layers_ = 1;
    int unit_extent_ = 1, unit_bytes_ = 0;
    std::array<uint32_t, 4> mask_{};
    std::vector<std::vector<std::byte>> level_data_;  ///< per level: layer after layer
};

}  // namespace rawtexel::reference
