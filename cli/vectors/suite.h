// A suite of test vectors: textures, cases, and what a right port answers. Made here from the texture unit itself, or read from files.
#pragma once

#include "cli/vectors/port_record.h"
#include "texunit/texture.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// A texture with every texel it has, levels finest first, in each slice by slice and row by row.
class SuiteTexture {
  public:
    /// `bytes`: texels or blocks of `format`, tightly packed. Asserts that there are as many as the shape asks for.
    SuiteTexture(std::string name, texunit::Format format, const texunit::Shape& shape, std::vector<std::byte> bytes);

    const std::string& name() const { return texture_->name(); }
    texunit::Format format() const { return texture_->format(); }
    const texunit::Shape& shape() const { return texture_->shape(); }
    /// As handed over: what a device's own texture unit is given.
    const std::vector<std::byte>& bytes() const { return *bytes_; }
    texunit::Texture& texture() const { return *texture_; }
    /// Adds linear RGBA of all texels, in the order of `bytes`.
    void append_texels(std::vector<float>& all) const;

  private:
    std::shared_ptr<const std::vector<std::byte>> bytes_;
    std::shared_ptr<texunit::Texture> texture_;
};

/// Of all slices of one level, and of all levels.
size_t texels_of_level(const texunit::Shape& shape, int level);
size_t texels_of(const texunit::Shape& shape);

/// Cases that try the same thing.
struct CaseGroup {
    std::string name;   ///< such as "mirror"
    std::string about;  ///< what goes wrong where a port fails, or which pitfall is tried
    uint32_t first = 0, count = 0;
    bool exact = false;  ///< coordinates, levels and numbers are such that every step is exact in 32-bit floats: no freedom but rounding
};

struct Suite {
    std::string name, about;
    std::vector<SuiteTexture> textures;
    std::vector<CaseRecord> cases;
    std::vector<Expectation> expected;  ///< one a case
    std::vector<CaseGroup> groups;      ///< they follow each other and hold all cases
    uint32_t left_out = 0;              ///< of a user's lookups: those whose texel lies within the freedom of a port
    std::vector<uint32_t> words;        ///< data of the suite, such as the masks of noises

    const CaseGroup& group_of(size_t index) const;
};

struct SuiteInfo {
    std::string_view name;
    std::string_view description;  ///< one line for people
};
std::span<const SuiteInfo> all_suites();

/// The same bits every time, on every machine. Nullopt for an unknown name.
std::optional<Suite> make_suite(std::string_view name);

/// Records of the suite's textures as ports see them, and the linear texels and stored words that these point into.
struct TextureTables {
    std::vector<TextureRecord> records;
    std::vector<float> texels;    ///< RGBA
    std::vector<uint32_t> words;  ///< Suite::words, then texels or blocks of textures that are not 32-bit floats
};
TextureTables texture_tables(const Suite& suite);

}  // namespace rawtexel::cli
