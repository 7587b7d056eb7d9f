// OpenGL without a window: a second decoder of blocks for the tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::texunit {

/// Has a context of its own (tests/texunit/gl_context.h).
class HeadlessGl {
  public:
    /// Null when there is none, with the reason.
    static std::unique_ptr<HeadlessGl> make(std::string& why_not);
    ~HeadlessGl();
    HeadlessGl(const HeadlessGl&) = delete;
    HeadlessGl& operator=(const HeadlessGl&) = delete;

    std::string renderer() const;  ///< such as "llvmpipe (LLVM 15.0.6, 256 bits)"

    /// The RGBA values of every texel of a block-compressed image, row by row, as a shader's texelFetch reads them.
    /// `internal_format` is OpenGL's number. Empty when the driver refuses the image.
    std::vector<float> texels(uint32_t internal_format, int width, int height, std::span<const std::byte> blocks);

  private:
    struct Functions;
    explicit HeadlessGl(std::unique_ptr<Functions> functions);
    std::unique_ptr<Functions> gl_;
};

}  // namespace rawtexel::texunit
