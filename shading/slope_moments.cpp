#include "shading/slope_moments.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstring>

namespace rawtexel::shading {
namespace {

/// Steeper texels, which point along the surface or into it, count as this steep: 86 degrees.
constexpr float kLeastZ = 1.0f / 16;

glm::vec2 slope(const std::array<float, 4>& code) {
    const glm::vec3 direction = 2.0f * glm::vec3(code[0], code[1], code[2]) - 1.0f;
    const glm::vec3 unit = direction / std::max(glm::length(direction), 1e-6f);
    return glm::vec2(unit) / std::max(unit.z, kLeastZ);
}

enum class Moments { Powers, Product };

class MomentSource : public texunit::TexelSource {
  public:
    MomentSource(texunit::Texture& normals, Moments moments) : normals_(normals), moments_(moments) {}

    texunit::Format format() const override { return texunit::Format::RGBA32Float; }
    texunit::Shape shape() const override { return {.width = normals_.shape().width, .height = normals_.shape().height}; }
    uint64_t stored_bytes() const override { return texunit::stored_bytes(format(), shape().width, shape().height); }

    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        const texunit::Shape extents = shape();
        for (int i = 0; i < texunit::kTexelsPerBlock; ++i) {
            const int x = std::min(4 * block_x + i % 4, extents.width - 1), y = std::min(4 * block_y + i / 4, extents.height - 1);
            const glm::vec2 m = slope(normals_.texel(0, 0, x, y));
            const glm::vec4 value = moments_ == Moments::Powers ? glm::vec4(m, m * m) : glm::vec4(m.x * m.y, 0, 0, 1);
            std::memcpy(texels + size_t(i) * sizeof(value), &value, sizeof(value));
        }
    }

  private:
    texunit::Texture& normals_;
    Moments moments_;
};

std::unique_ptr<texunit::Texture> make_texture(texunit::Texture& normals, Moments moments) {
    return std::make_unique<texunit::Texture>(normals.name() + " (moments)", std::make_unique<MomentSource>(normals, moments));
}

}  // namespace

SlopeMoments make_slope_moments(texunit::Texture& normals, bool with_product) {
    return {make_texture(normals, Moments::Powers), with_product ? make_texture(normals, Moments::Product) : nullptr};
}

uint64_t slope_moment_bytes(const texunit::Shape& normals, bool with_product) {
    const uint64_t texels = uint64_t(normals.width) * uint64_t(normals.height);
    const uint64_t pyramid = texels * uint64_t(bytes_per_texel(texunit::StorageClass::Float4)) * 4 / 3;
    return pyramid * (with_product ? 2 : 1);
}

}  // namespace rawtexel::shading
