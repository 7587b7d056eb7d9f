// How textures are opened and looked up: the options that every command with lookups shares.
#pragma once

#include "cli/command_line.h"
#include "shading/filtering_options.h"
#include "shading/footprint_options.h"
#include "texunit/containers.h"
#include "texunit/sampler.h"
#include "texunit/texture.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rawtexel::cli {

struct LookupOptions {
    std::optional<texunit::Kernel> filter;  ///< unset: what the scene's samplers say
    std::optional<texunit::MipMode> mip;
    shading::FootprintOptions footprint;
    shading::FilteringOptions filtering;
    bool names_lod_rule = false;  ///< whether --lod-rule was given, whatever it says
    texunit::Precision precision = texunit::Precision::Exact;
    texunit::MipStorage mip_storage = texunit::MipStorage::Source;
    texunit::ContainerOptions files;
};

/// --filter, --mip, --precision, --mip-storage, and those of texture files. Footprints have their own (cli/footprint_options.h).
void declare_lookup_options(CommandLine& line, LookupOptions& lookup);

/// Throws UsageError where one option leaves another without effect: of footprints, their bias and the ellipse.
void check_lookup(const LookupOptions& lookup);

// The readers throw UsageError.
std::optional<texunit::Kernel> parse_filter(std::string_view text);  // scene, or a kernel as texunit::parse_kernel takes it
std::string print_filter(const std::optional<texunit::Kernel>& filter);
std::optional<texunit::MipMode> parse_mip(std::string_view text);  // scene linear nearest none
std::string print_mip(const std::optional<texunit::MipMode>& mip);
texunit::MipStorage parse_mip_storage(std::string_view text);  // source float
std::string print(texunit::MipStorage storage);

/// Throws UsageError for --texture-jitter beside what else would filter minified textures.
void check_texture_jitter(const LookupOptions& lookup);

/// Every choice by its option's name without the dashes, spelled as the command line takes it: for metadata and statistics.
std::vector<std::pair<std::string, std::string>> print_choices(const LookupOptions& lookup);

}  // namespace rawtexel::cli
