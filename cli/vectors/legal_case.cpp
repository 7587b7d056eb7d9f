#include "cli/vectors/legal_case.h"

namespace rawtexel::cli {

std::array<double, 4> judged_colour(const std::array<float, 4>& value) {
    return {double(value[0]), double(value[1]), double(value[2]), double(value[3])};
}

texunit::JudgedTexture judged_texture(const Suite& suite, const CaseRecord& record) {
    texunit::Texture& texture = suite.textures[record.texture].texture();
    return {texture.shape(), [&](int level, int slice, int x, int y) { return judged_colour(texture.texel(level, slice, x, y)); }};
}

texunit::JudgedLookup judged_lookup(const CaseRecord& record) {
    const auto widen = [](const std::array<float, 3>& v) { return std::array<double, 3>{double(v[0]), double(v[1]), double(v[2])}; };
    return {widen(record.at), widen(record.dx), widen(record.dy), double(record.layer)};
}

}  // namespace rawtexel::cli
