#include "cli/explanation_report.h"

#include "cli/lookup_report.h"
#include "cli/option_values.h"
#include "cli/word_list.h"
#include "scenes/message_text.h"

#include <algorithm>

namespace rawtexel::cli {
namespace {

using shading::AlphaMode;

/// `text`, every line of it `spaces` to the right.
std::string indented(const std::string& text, size_t spaces) {
    std::string result;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        result += std::string(spaces, ' ') + text.substr(begin, end - begin) + "\n";
        begin = end + 1;
    }
    return result;
}

std::string quoted(const std::string& name) { return name.empty() ? "" : " '" + scenes::one_line(name) + "'"; }

std::string print_double(double value) { return print_number(float(value)); }

/// Its triangle, where it belongs and what it is made of.
std::string describe(const ExplainedTriangle& triangle) {
    const auto number = [](uint32_t value) { return std::to_string(value); };
    return std::string("triangle ") + number(triangle.id) + ", the " + (triangle.front ? "front" : "back") + " of triangle " +
           number(triangle.primitive) + " of instance " + number(triangle.instance) + quoted(triangle.mesh->name) + ", material " +
           number(triangle.material_index) + quoted(triangle.material->name);
}

std::string describe(const AlphaVerdict& verdict, AlphaMode mode) {
    const std::string alpha = print_number(verdict.alpha), threshold = print_number(verdict.threshold);
    if (verdict.random_surface == 0)
        return "MASK: alpha " + alpha + (verdict.covers ? " >= " : " < ") + "cutoff " + threshold +
               (verdict.covers ? ": covers" : ": lets through");
    const std::string share = mode == AlphaMode::Mask ? "MASK: random number " + threshold : "BLEND: random number " + threshold;
    return share + (verdict.covers ? " < " : " >= ") + (mode == AlphaMode::Mask ? "share of texels that pass " : "alpha ") + alpha +
           (verdict.covers ? ": covers" : ": lets through") + " (dimension coverage of surface " + std::to_string(verdict.random_surface) +
           ")";
}

std::string describe(const ExplainedTexel& texel) {
    const std::string place =
        texel.border ? "border"
                     : "level " + std::to_string(texel.level) + ", texel " + std::to_string(texel.x) + "," + std::to_string(texel.y);
    return std::string(name_of(texel.slot)) + ": " + place + ", value " + print_vector(glm::vec3(texel.value)) + "," +
           print_number(texel.value.a);
}

std::string describe(const ExplainedLookup& lookup) {
    if (lookup.drawn)
        return "Map: " + std::string(name_of(lookup.slot)) + ", " + scenes::one_line(lookup.texture->name()) + " at " +
               print_number(lookup.at.u) + "," + print_number(lookup.at.v) + ": texels below (" +
               std::string(to_string(lookup.sampler.estimator)) + ")\n";
    const texunit::LookupTrace trace = trace_lookup(*lookup.texture, lookup.sampler, lookup.at);
    const LookupPlace place = place_of(lookup.at);
    std::vector<std::string> value;
    for (const float channel : trace.result) value.push_back(print_number(channel));
    return "Map: " + std::string(name_of(lookup.slot)) + "\n" +
           indented(lookup_table({*lookup.texture, lookup.sampler, place, trace}) + "Value: " + join(value, ",") + "\n", 2);
}

std::string describe(const ExplainedCandidate& candidate) {
    std::string text = "In front: " + describe(candidate.triangle) + "\n";
    text += indented(describe(candidate.verdict, candidate.triangle.material->alpha_mode), 2);
    if (candidate.lookup) text += indented(describe(*candidate.lookup), 2);
    return text;
}

std::string describe(const ExplainedReflection& reflection) {
    std::string text = "Metallic: " + print_number(reflection.metallic) + ", roughness: " + print_number(reflection.roughness) +
                       ", occlusion: " + print_number(reflection.occlusion) + ", emission: " + print_vector(reflection.emission) +
                       "\nLight, added up in this order:\n";
    for (const shading::LightTerm& term : reflection.light)
        text += "  " + scenes::one_line(term.source) + ": " + print_vector(term.radiance) + "\n";
    return text;
}

std::string describe(const ExplainedTap& tap) {
    std::string text = "Tap: weight " + print_number(tap.weight) + (tap.alpha ? ", alpha " + print_number(*tap.alpha) : "") + "\n", details;
    if (tap.numbers) {
        const ExplainedNumbers& n = *tap.numbers;
        details += "Random numbers: x " + print_number(n.x) + ", y " + print_number(n.y) + ", level " + print_number(n.level) + ", probe " +
                   print_number(n.probe) + ", sign " + print_number(n.sign) + "\n";
    }
    for (const ExplainedTexel& texel : tap.texels) details += describe(texel) + "\n";
    details += "Base colour: " + print_vector(tap.base_color) + "\nNormal: " + print_vector(tap.normal) + "\n";
    if (tap.reflection) details += describe(*tap.reflection);
    return text + indented(details + "Radiance: " + print_vector(tap.radiance) + "\n", 2);
}

/// What a surface or one of its branches is made of.
std::string describe_matter(const ExplainedSurface& surface) {
    std::string text;
    for (const ExplainedTexel& texel : surface.averaged)
        text += "Drawn and averaged, weight " + print_number(texel.weight) + ", " + describe(texel) + "\n";
    if (!surface.taps.empty()) {
        text += "Radiance: the sum of weight x radiance over these taps, of which those of positive weight count as far as they cover\n";
        for (const ExplainedTap& tap : surface.taps) text += describe(tap);
        return text;
    }
    text += "Base colour: " + print_vector(surface.base_color) + "\n";
    text += "Normal: " + print_vector(surface.normal) + ", of the triangle " + print_vector(surface.geometric_normal) + "\n";
    if (surface.reflection) return text + describe(*surface.reflection);
    return surface.triangle.material->unlit ? text + "Unlit: the base colour is the radiance\n" : text;
}

std::string describe_branch(const ExplainedSurface& branch) {
    std::string details;
    for (const ExplainedLookup& lookup : branch.lookups) details += describe(lookup);
    details += describe_matter(branch);
    if (branch.radiance) details += "Radiance: " + print_vector(*branch.radiance) + "\n";
    return "Blended: weight " + print_number(branch.weight) + ", material " + std::to_string(branch.triangle.material_index) +
           quoted(branch.triangle.material->name) + "\n" + indented(details, 2);
}

std::string describe(const ExplainedSurface& surface) {
    std::string text = "Surface: " + describe(surface.triangle) + "\n", details;
    if (surface.verdict) details += describe(*surface.verdict, surface.triangle.material->alpha_mode) + "\n";
    details += "Barycentrics: " + print_vector(surface.barycentrics) + "\n";
    details += "Position: " + print_vector(surface.position) + " m, " + print_number(surface.distance) + " m along the view axis\n";
    if (!surface.numbers.empty()) {
        std::vector<std::string> numbers;
        for (const ExplainedNumber& each : surface.numbers)
            numbers.push_back(std::string(each.dimension) + " " + print_number(each.number));
        details += "Random numbers: " + join(numbers, ", ") + "\n";
    }
    for (const ExplainedLookup& lookup : surface.lookups) details += describe(lookup);
    for (const ExplainedSurface& branch : surface.branches) details += describe_branch(branch);
    if (surface.vertex_color) {
        const glm::vec4& color = *surface.vertex_color;
        details += "Vertex colour: " + print_vector(glm::vec3(color)) + "," + print_number(color.a) + "\n";
    }
    const bool blends_light = !surface.branches.empty() && surface.branches[0].radiance;
    details += blends_light ? "Radiance: the sum of weight x radiance over what is blended\n" : describe_matter(surface);
    return text + indented(details, 2);
}

class ExplanationText final : public ExplanationReport {
  public:
    explicit ExplanationText(std::ostream& out) : out_(out) {}

    void begin(const ExplainedPixel& pixel) override {
        spp_ = pixel.spp;
        out_ << "Pixel " << pixel.x << ',' << pixel.y << " of " << pixel.width << 'x' << pixel.height << ", scene "
             << scenes::one_line(pixel.scene) << "\nCamera: " << pixel.camera << "\nSamples: " << pixel.spp << ", pixel filter "
             << to_string(pixel.pixel_filter) << ", pixel jitter " << to_string(pixel.pixel_jitter) << ", seed " << pixel.seed << '\n';
    }

    void sample(const ExplainedSample& sample) override {
        const float one = float(raster::kSampleOne);
        out_ << "\nSample " << sample.sample << "\n  Point: " << print_number(float(sample.offset.x) / one) << ','
             << print_number(float(sample.offset.y) / one) << " from the pixel's upper left corner (random shift of the sequence "
             << print_double(double(sample.shift.x) * 0x1p-32) << ',' << print_double(double(sample.shift.y) * 0x1p-32) << ")\n";
        for (const ExplainedCandidate& candidate : sample.let_through) out_ << indented(describe(candidate), 2);
        out_ << indented(sample.surface ? describe(*sample.surface) : "Background: no surface is seen\n", 2);
        out_ << "  Radiance: " << print_vector(sample.radiance) << ", weight 1/" << spp_ << '\n';
    }

    void end(const ExplainedMean* mean) override {
        if (!mean) return;
        out_ << "\nMean: " << print_vector(mean->mean) << "\nRendered: " << print_vector(mean->rendered)
             << (same_bits(mean->mean, mean->rendered) ? ", the same bits\n" : ", which DIFFERS\n") << "Displayed in 8 bits ("
             << mean->display << "): " << int(mean->codes[0]) << ',' << int(mean->codes[1]) << ',' << int(mean->codes[2]) << '\n';
    }

  private:
    std::ostream& out_;
    int spp_ = 1;
};

}  // namespace

std::unique_ptr<ExplanationReport> make_explanation_text(std::ostream& out) { return std::make_unique<ExplanationText>(out); }

}  // namespace rawtexel::cli
