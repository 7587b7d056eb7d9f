#include "cli/metadata.h"

#include "cli/image_output.h"
#include "cli/option_values.h"
#include "cli/version.h"

namespace rawtexel::cli {

scenes::Metadata image_metadata(const RunRecord& record, bool has_display_transform) {
    const RenderRequest& request = record.request;
    scenes::Metadata metadata{
        {"Software", "rawtexel " + std::string(version())},
        {"ImageDescription", record.command},
        {"rawtexel:version", std::string(version())},
        {"rawtexel:command", record.command},
        {"rawtexel:scene", record.scene},
        {"rawtexel:camera", record.view},
        {"rawtexel:seed", std::to_string(request.samples.seed)},
        {"rawtexel:spp", std::to_string(request.samples.spp)},
        {"rawtexel:pixel-filter", std::string(to_string(request.samples.pixel_filter))},
        {"rawtexel:pixel-jitter", std::string(to_string(request.samples.pixel_jitter))},
    };
    if (request.samples.adaptive) metadata.emplace_back("rawtexel:adaptive", print_number(*request.samples.adaptive));
    if (record.standard_error) metadata.emplace_back("rawtexel:standard_error", print_number(float(*record.standard_error)));
    if (request.sequence.is_sequence()) {
        metadata.emplace_back("rawtexel:frames", std::to_string(request.sequence.frames));
        metadata.emplace_back("rawtexel:accumulate", print_accumulate(request.sequence));
        if (request.sequence.path) metadata.emplace_back("rawtexel:camera-path", print(*request.sequence.path));
    }
    for (const auto& [name, choice] : print_choices(request.lookup)) metadata.emplace_back("rawtexel:" + name, choice);
    if (request.crop.width > 0) metadata.emplace_back("rawtexel:crop", print(request.crop));
    if (has_display_transform) {
        const shading::DisplayOptions display = display_options(request.tone);
        metadata.emplace_back("rawtexel:exposure", print_number(display.exposure));
        metadata.emplace_back("rawtexel:tonemap", std::string(to_string(display.tone_map)));
        metadata.emplace_back("rawtexel:transfer", std::string(to_string(display.transfer)));
    }
    if (record.result.fetches) {
        const texunit::FetchCounts fetches = record.result.fetches->total();
        metadata.emplace_back("rawtexel:fetch-model", std::string(to_string(request.fetches.model.value_or(shading::FetchModel::Visible))));
        if (request.fetches.cache) metadata.emplace_back("rawtexel:cache", to_string(*request.fetches.cache));
        metadata.emplace_back("rawtexel:lookups", std::to_string(fetches.lookups));
        metadata.emplace_back("rawtexel:taps", std::to_string(fetches.taps));
        metadata.emplace_back("rawtexel:texels_requested", std::to_string(fetches.texels_requested));
    }
    return metadata;
}

}  // namespace rawtexel::cli
