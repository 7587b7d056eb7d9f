// Puts a suite together: textures, groups of cases, and numbers to make them from that are the same everywhere.
#pragma once

#include "cli/vectors/expectation.h"
#include "texunit/random.h"

#include <string>
#include <utility>

namespace rawtexel::cli {

class SuiteBuilder {
  public:
    SuiteBuilder(std::string_view name, std::string_view about);

    /// Returns its number. The levels of noise textures have nothing in common, so that a wrong one shows.
    uint32_t add_texture(SuiteTexture texture);
    uint32_t add_noise_texture(std::string name, const texunit::Shape& extents);
    uint32_t add_constant_texture(std::string name, int width, int height, const std::array<float, 4>& value);

    /// Cases added from now on belong to it.
    void begin_group(std::string name, std::string about, bool exact = false);
    /// False where the answer would lie within the freedom of a port: the case is left out then.
    bool add(const CaseRecord& record);
    /// Adds `count` cases of make(), which draws what it needs, and makes anew those that would be left out.
    template <class Make>
    void add_some(int count, const Make& make) {
        for (int tries = 0; count > 0 && tries < 64 * 1000; ++tries) {
            if (add(make())) --count;
        }
    }

    uint32_t bits() { return texunit::mix_bits(texunit::mix_bits(seed_ ^ texunit::kRandomStart) + counter_++ * texunit::kRandomStart); }
    float unit() { return texunit::unit_float(bits()); }
    float between(float least, float most) { return least + (most - least) * unit(); }
    int below(int count) { return int(bits() % uint32_t(count)); }
    bool chance(float probability) { return unit() < probability; }

    /// All of a draw's numbers.
    void draw_numbers(CaseRecord& record);
    /// A footprint whose longer axis is `longer` texels of level 0 and whose other is `ratio` times shorter, turned at random.
    void draw_footprint(CaseRecord& record, float longer, float ratio);

    Suite& suite() { return suite_; }
    Suite take();

  private:
    Suite suite_;
    uint32_t seed_, counter_ = 0;
};

/// A texture of a compressed format with all its levels: random blocks, and such as random ones hardly hit. Returns its number.
uint32_t add_block_texture(SuiteBuilder& builder, texunit::Format format);

/// Makers of the suites, by topic.
Suite make_addressing_suite();
Suite make_lod_suite();
Suite make_anisotropy_suite();
Suite make_kernels_suite();
Suite make_positivization_suite();
Suite make_mip_choice_suite();
Suite make_elliptical_suite();
Suite make_triplanar_suite();
Suite make_bc_decode_suite();
Suite make_srgb_suite();
Suite make_random_numbers_suite();
Suite make_noise_suite();
Suite make_adversarial_suite();
Suite make_hardware_suite();

}  // namespace rawtexel::cli
