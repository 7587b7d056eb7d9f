#include "cli/commands/sample.h"

#include "cli/lookup_report.h"
#include "cli/sample_request.h"
#include "texunit/draw_trace.h"
#include "texunit/lookup_trace.h"

namespace rawtexel::cli {
namespace {

using texunit::LookupTrace;
using texunit::SamplerState;
using texunit::Shape;
using texunit::Texture;

LookupTrace trace_place(Texture& texture, const SamplerState& sampler, const LookupPlace& place, int layer) {
    const auto [dx, dy] = place.derivatives.value_or(Derivatives{});
    const auto& at = place.at;
    switch (coordinate_kind(texture.shape())) {
        case CoordinateKind::Uvw: return trace_volume_lookup(texture, sampler, {at, dx, dy});
        case CoordinateKind::Direction: return trace_cube_lookup(texture, sampler, {at, dx, dy}, float(layer));
        case CoordinateKind::Uv: break;
    }
    return trace_lookup(texture, sampler, {at[0], at[1], dx[0], dx[1], dy[0], dy[1]}, float(layer));
}

texunit::DrawTrace draw_place(Texture& texture, const SamplerState& sampler, const LookupPlace& place, int layer,
                              const texunit::DrawSource& source) {
    const auto [dx, dy] = place.derivatives.value_or(Derivatives{});
    const auto& at = place.at;
    switch (coordinate_kind(texture.shape())) {
        case CoordinateKind::Uvw: return trace_volume_draws(texture, sampler, {at, dx, dy}, source);
        case CoordinateKind::Direction: return trace_cube_draws(texture, sampler, {at, dx, dy}, source, float(layer));
        case CoordinateKind::Uv: break;
    }
    return trace_draws(texture, sampler, {at[0], at[1], dx[0], dx[1], dy[0], dy[1]}, source, float(layer));
}

/// Throws UsageError for a wrap of an axis that there is not, and for a border colour that no axis takes.
void check_wraps(const std::string& name, CoordinateKind kind, const SamplerState& sampler, const SampleRequest& request) {
    if (kind == CoordinateKind::Uv && request.wraps_given > 2) throw UsageError("--wrap: '" + name + "' is flat (allowed: S[,T])");
    const texunit::Wrap border = texunit::Wrap::ClampToBorder;
    const bool bordered = sampler.wrap_s == border || sampler.wrap_t == border || (kind == CoordinateKind::Uvw && sampler.wrap_r == border);
    if (request.border && !bordered) throw UsageError("--border without --wrap border: no axis has a border");
}

/// Throws UsageError where the options ask for what a texture of this shape does not have.
void check_shape(const std::string& name, const Shape& shape, const SampleRequest& request) {
    const CoordinateKind given = request.coordinates->kind, needed = coordinate_kind(shape);
    const std::string what = needed == CoordinateKind::Direction ? "a cube map" : needed == CoordinateKind::Uvw ? "a volume" : "flat";
    if (given != needed)
        throw UsageError(std::string(option_of(given)) + ": '" + name + "' is " + what + " (allowed: " + std::string(option_of(needed)) +
                         " " + std::string(form_of(needed)) + ")");
    const texunit::SamplerState sampler = make_sampler(request);
    if (needed != CoordinateKind::Uv && (sampler.probes > 1 || sampler.ellipse > 0))
        throw UsageError(std::string(sampler.ellipse > 0 ? "--ewa" : "--aniso") + ": '" + name + "' is " + what +
                         ", which is filtered isotropically");
    if (shape.cube && (request.wraps || request.border))
        throw UsageError(std::string(request.wraps ? "--wrap" : "--border") + ": '" + name + "' is a cube map, which has no edges");
    check_wraps(name, needed, sampler, request);
    const int layers = shape.cubes();
    if (request.layer >= layers)
        throw UsageError("--layer: '" + name + "' has no layer " + std::to_string(request.layer) + " (0 to " + std::to_string(layers - 1) +
                         ")");
}

class SampleCommand : public Command {
  public:
    std::string_view name() const override { return "sample"; }
    std::string_view usage() const override { return "sample TEXTURE --uv U,V [--ddx A,B --ddy C,D | --lod L] [options]"; }
    std::string_view summary() const override {
        return "Explains one texture lookup: its level of detail, every texel that it weighs or the one that it draws, and the result, in "
               "linear RGBA. Derivatives are those of the coordinates over one pixel.";
    }

    void declare(CommandLine& line) override {
        line.arguments("TEXTURE", "a .dds or .ktx2 file, or any image", 1, 1, words_);
        line.flag("--json",
                  "one JSON object instead of a table: \"lod\", \"anisotropy\", \"precision\", \"taps\" and \"result\", and \"estimator\" "
                  "where it draws; with @FILE one a line, always",
                  json_);
        declare_sample_request(line, request_);
    }

    int run(const Invocation& invocation) override {
        const std::vector<LookupPlace> places = settle_places(request_, usage());
        TextureFile file = open_texture_file(words_[0], request_.color_space, request_.lookup.files);
        check_shape(words_[0], file.source->shape(), request_);
        Texture texture(words_[0], std::move(file.source), {.mip_storage = request_.lookup.mip_storage});
        const SamplerState sampler = make_sampler(request_);
        const bool many = !request_.coordinates->file.empty();
        for (size_t n = 0; n < places.size(); ++n) {
            const LookupPlace& place = places[n];
            const LookupTrace trace = trace_place(texture, sampler, place, request_.layer);
            texunit::DrawTrace drawn;
            if (request_.is_drawn()) drawn = draw_place(texture, sampler, place, request_.layer, make_draw_source(request_, n));
            const ReportedLookup lookup{texture, sampler, place, trace, request_.is_drawn() ? &drawn : nullptr};
            invocation.out << (json_ || many ? lookup_json(lookup) : lookup_table(lookup));
        }
        return kDone;
    }

  private:
    std::vector<std::string> words_;
    SampleRequest request_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_sample_command() { return std::make_unique<SampleCommand>(); }

}  // namespace rawtexel::cli
