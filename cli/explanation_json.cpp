#include "cli/explanation_report.h"

#include "cli/lookup_report.h"
#include "cli/version.h"

#include <nlohmann/json.hpp>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;
using shading::AlphaMode;

Json numbers(const glm::vec2& v) { return {v.x, v.y}; }
Json numbers(const glm::vec3& v) { return {v.x, v.y, v.z}; }
Json numbers(const glm::vec4& v) { return {v.x, v.y, v.z, v.w}; }

/// The maps by their names in a glTF file.
std::string_view key_of(shading::MapSlot slot) {
    constexpr std::array<std::string_view, shading::kMapSlots + 1> kKeys{"baseColorTexture", "metallicRoughnessTexture", "normalTexture",
                                                                         "occlusionTexture", "emissiveTexture",          "layers.mask"};
    return kKeys[size_t(slot)];
}

Json lookup_json_of(const ExplainedLookup& lookup) {
    const texunit::LaneCoordinates& at = lookup.at;
    const texunit::SamplerState& sampler = lookup.sampler;
    Json json{{"map", key_of(lookup.slot)},
              {"texture", lookup.texture->name()},
              {"uv", {at.u, at.v}},
              {"ddx", {at.dudx, at.dvdx}},
              {"ddy", {at.dudy, at.dvdy}},
              {"sampler",
               {{"magnify", to_string(sampler.magnify)},
                {"minify", to_string(sampler.minify)},
                {"mip", to_string(sampler.mip)},
                {"wrap", {to_string(sampler.wrap_s), to_string(sampler.wrap_t)}},
                {"probes", sampler.probes},
                {"probe_variance", sampler.probe_variance},
                {"ellipse", sampler.ellipse},
                {"lod_rule", to_string(sampler.lod_rule)},
                {"lod_bias", sampler.lod_bias}}}};
    if (lookup.drawn) {
        json["estimator"] = to_string(sampler.estimator);
        return json;
    }
    const texunit::LookupTrace trace = trace_lookup(*lookup.texture, sampler, at);
    json.update(lookup_object({*lookup.texture, sampler, place_of(at), trace}));
    return json;
}

void add_triangle(const ExplainedTriangle& triangle, Json& json) {
    json["triangle"] = triangle.id;
    json["instance"] = triangle.instance;
    json["mesh"] = triangle.mesh->name;
    json["mesh_triangle"] = triangle.primitive;
    json["material"] = triangle.material_index;
    json["material_name"] = triangle.material->name;
    json["front"] = triangle.front;
}

void add_verdict(const AlphaVerdict& verdict, AlphaMode mode, Json& json) {
    json["alpha_mode"] = mode == AlphaMode::Mask ? "MASK" : "BLEND";
    json["alpha"] = verdict.alpha;
    if (verdict.random_surface == 0) {
        json["cutoff"] = verdict.threshold;
    } else {
        json["random"] = {{"dimension", "coverage"}, {"surface", verdict.random_surface}, {"number", verdict.threshold}};
    }
    json["covers"] = verdict.covers;
}

Json candidate_json(const ExplainedCandidate& candidate) {
    Json json = Json::object();
    add_triangle(candidate.triangle, json);
    add_verdict(candidate.verdict, candidate.triangle.material->alpha_mode, json);
    json["maps"] = Json::array();
    if (candidate.lookup) json["maps"].push_back(lookup_json_of(*candidate.lookup));
    return json;
}

void add_reflection(const ExplainedReflection& reflection, Json& json) {
    json["metallic"] = reflection.metallic;
    json["roughness"] = reflection.roughness;
    json["occlusion"] = reflection.occlusion;
    json["emission"] = numbers(reflection.emission);
    json["light"] = Json::array();
    for (const shading::LightTerm& term : reflection.light)
        json["light"].push_back({{"source", term.source}, {"radiance", numbers(term.radiance)}});
}

Json texels_json(const std::vector<ExplainedTexel>& texels) {
    Json json = Json::array();
    for (const ExplainedTexel& texel : texels) {
        Json& each = json.emplace_back(Json{{"map", key_of(texel.slot)}, {"weight", texel.weight}});
        if (texel.border) {
            each["border"] = true;
        } else {
            each.update({{"level", texel.level}, {"x", texel.x}, {"y", texel.y}});
        }
        each["value"] = numbers(texel.value);
    }
    return json;
}

Json tap_json(const ExplainedTap& tap) {
    Json json{{"weight", tap.weight}};
    if (tap.alpha) json["alpha"] = *tap.alpha;
    if (tap.numbers) {
        const ExplainedNumbers& n = *tap.numbers;
        json["random"] = {{"x", n.x}, {"y", n.y}, {"level", n.level}, {"probe", n.probe}, {"sign", n.sign}};
    }
    json["texels"] = texels_json(tap.texels);
    json["base_color"] = numbers(tap.base_color);
    json["normal"] = numbers(tap.normal);
    if (tap.reflection) add_reflection(*tap.reflection, json);
    json["radiance"] = numbers(tap.radiance);
    return json;
}

/// What a surface or one of its branches is made of.
void add_matter(const ExplainedSurface& surface, Json& json) {
    json["maps"] = Json::array();
    for (const ExplainedLookup& lookup : surface.lookups) json["maps"].push_back(lookup_json_of(lookup));
    if (!surface.averaged.empty()) json["averaged"] = texels_json(surface.averaged);
    if (surface.taps.empty()) {
        json["base_color"] = numbers(surface.base_color);
        if (surface.reflection) add_reflection(*surface.reflection, json);
    }
    for (const ExplainedTap& tap : surface.taps) json["taps"].push_back(tap_json(tap));
}

Json branch_json(const ExplainedSurface& branch) {
    Json json{{"weight", branch.weight}, {"material", branch.triangle.material_index}, {"material_name", branch.triangle.material->name}};
    json["normal"] = numbers(branch.normal);
    add_matter(branch, json);
    if (branch.radiance) json["radiance"] = numbers(*branch.radiance);
    return json;
}

Json surface_json(const ExplainedSurface& surface) {
    Json json = Json::object();
    add_triangle(surface.triangle, json);
    if (surface.verdict) add_verdict(*surface.verdict, surface.triangle.material->alpha_mode, json);
    json["barycentrics"] = numbers(surface.barycentrics);
    json["position"] = numbers(surface.position);
    json["depth"] = surface.distance;
    json["geometric_normal"] = numbers(surface.geometric_normal);
    json["normal"] = numbers(surface.normal);
    if (surface.vertex_color) json["vertex_color"] = numbers(*surface.vertex_color);
    for (const ExplainedNumber& each : surface.numbers) json["numbers"][std::string(each.dimension)] = each.number;
    add_matter(surface, json);
    for (const ExplainedSurface& branch : surface.branches) json["branches"].push_back(branch_json(branch));
    return json;
}

Json sample_json(const ExplainedSample& sample, int spp) {
    Json let_through = Json::array();
    for (const ExplainedCandidate& candidate : sample.let_through) let_through.push_back(candidate_json(candidate));
    const glm::vec2 offset(float(sample.offset.x), float(sample.offset.y));
    return {{"sample", sample.sample},
            {"weight", 1.0 / spp},
            {"offset", numbers(offset / float(raster::kSampleOne))},
            {"sequence_shift", {double(sample.shift.x) * 0x1p-32, double(sample.shift.y) * 0x1p-32}},
            {"let_through", std::move(let_through)},
            {"surface", sample.surface ? surface_json(*sample.surface) : Json(nullptr)},
            {"radiance", numbers(sample.radiance)}};
}

/// Names come from files: bytes that are no UTF-8 are replaced, not refused.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

class ExplanationJson final : public ExplanationReport {
  public:
    explicit ExplanationJson(std::ostream& out) : out_(out) {}

    void begin(const ExplainedPixel& pixel) override {
        spp_ = pixel.spp;
        const Json json{{"rawtexel", version()},
                        {"scene", pixel.scene},
                        {"camera", pixel.camera},
                        {"size", {pixel.width, pixel.height}},
                        {"pixel", {pixel.x, pixel.y}},
                        {"spp", pixel.spp},
                        {"pixel_filter", to_string(pixel.pixel_filter)},
                        {"pixel_jitter", to_string(pixel.pixel_jitter)},
                        {"seed", pixel.seed}};
        std::string text = text_of(json);
        text.pop_back();  // the brace, which end() sets
        out_ << text << ",\"samples\":[";
    }

    void sample(const ExplainedSample& sample) override {
        out_ << (first_ ? "\n" : ",\n") << text_of(sample_json(sample, spp_));
        first_ = false;
    }

    void end(const ExplainedMean* mean) override {
        out_ << "\n]";
        const auto member = [this](const char* name, const Json& value) { out_ << ",\"" << name << "\":" << text_of(value); };
        if (mean) {
            member("mean", numbers(mean->mean));
            member("rendered", numbers(mean->rendered));
            member("display", mean->codes);
        }
        out_ << "}\n";
    }

  private:
    std::ostream& out_;
    int spp_ = 1;
    bool first_ = true;
};

}  // namespace

std::unique_ptr<ExplanationReport> make_explanation_json(std::ostream& out) { return std::make_unique<ExplanationJson>(out); }

}  // namespace rawtexel::cli
