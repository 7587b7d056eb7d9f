#include "cli/vectors/suite_builder.h"

#include <algorithm>
#include <array>

namespace rawtexel::cli {
namespace {

struct KnownSuite {
    SuiteInfo info;
    Suite (*make)();
};
constexpr std::array kSuites = {
    KnownSuite{{"addressing", "wraps of indices and coordinates, nearest and bilinear"}, make_addressing_suite},
    KnownSuite{{"lod", "the level of detail, its bias and bounds"}, make_lod_suite},
    KnownSuite{{"anisotropy", "number, places and level of anisotropic probes"}, make_anisotropy_suite},
    KnownSuite{{"kernels", "every kernel with every estimator"}, make_kernels_suite},
    KnownSuite{{"positivization", "kernels with negative lobes, drawn"}, make_positivization_suite},
    KnownSuite{{"mip-choice", "one of two levels, drawn"}, make_mip_choice_suite},
    KnownSuite{{"elliptical", "the exact ellipse, weighed and drawn"}, make_elliptical_suite},
    KnownSuite{{"triplanar", "one of three planes, drawn"}, make_triplanar_suite},
    KnownSuite{{"bc-decode", "texels of BC1 to BC7"}, make_bc_decode_suite},
    KnownSuite{{"srgb", "sRGB codes and back"}, make_srgb_suite},
    KnownSuite{{"random-numbers", "hashes of addresses"}, make_random_numbers_suite},
    KnownSuite{{"noise", "white, sobol, r2, blue and stbn"}, make_noise_suite},
    KnownSuite{{"adversarial", "every known pitfall of stochastic filtering, by name"}, make_adversarial_suite},
    KnownSuite{{"hardware", "the device's own texture unit: how many bits, how far from the ellipse, how it rounds"}, make_hardware_suite}};

constexpr auto kInfos = [] {
    std::array<SuiteInfo, kSuites.size()> infos;
    for (size_t i = 0; i < kSuites.size(); ++i) infos[i] = kSuites[i].info;
    return infos;
}();

}  // namespace

std::span<const SuiteInfo> all_suites() { return kInfos; }

std::optional<Suite> make_suite(std::string_view name) {
    const auto found = std::ranges::find(kSuites, name, [](const KnownSuite& suite) { return suite.info.name; });
    if (found == kSuites.end()) return std::nullopt;
    return found->make();
}

}  // namespace rawtexel::cli
