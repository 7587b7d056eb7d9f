#include "cli/fetch_options.h"

#include "cli/option_values.h"

namespace rawtexel::cli {

texunit::CacheSpec parse_cache(std::string_view text) {
    std::string error;
    const std::optional<texunit::CacheSpec> spec = texunit::parse_cache_spec(text, error);
    if (!spec) throw UsageError("--cache: " + error);
    return *spec;
}

void declare_fetch_options(CommandLine& line, FetchRequest& fetches) {
    using shading::FetchModel;
    line.group("Fetches");
    line.flag("--count", "count lookups, taps, texels, blocks and cache lines, per texture and level", fetches.count);
    line.option(
        "--fetch-model", "visible|forward|quad",
        "whose fetches count: of what is seen (the default), of all that passes a depth test in scene order, or that in 2x2 quads with "
        "their helper lanes as GPUs have; implies --count",
        [&](const std::string& text) {
            fetches.model = parse_choice("--fetch-model", text, {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad});
        });
    line.option("--cache", "SPEC",
                "run the fetches through a modelled cache, too, which implies --count: any of "
                "line=BYTES,sectors=N,l1=BYTES:WAYS,l2=BYTES:WAYS,cores=N,"
                "holds=decoded|stored[:decoded|stored] (default " +
                    to_string(texunit::CacheSpec{}) + ")",
                [&](const std::string& text) { fetches.cache = parse_cache(text); });
}

}  // namespace rawtexel::cli
