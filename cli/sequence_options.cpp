#include "cli/sequence_options.h"

#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/word_list.h"

#include <filesystem>

namespace rawtexel::cli {
namespace {

using shading::Accumulation;

constexpr float kLeastWeight = 1e-4f;
constexpr int kMaxDigits = 9;

[[noreturn]] void fail_pattern(std::string_view pattern, const std::string& what) {
    throw UsageError("--frames-out: '" + std::string(pattern) + "' " + what + ", such as frame-%04d.png");
}

/// What follows the per cent sign at `at`: digits that ask for leading zeros, and a d. Moves `at` behind it.
std::string number_at(std::string_view pattern, size_t& at, int frame) {
    int digits = 0;
    size_t end = at + 1;
    if (end < pattern.size() && pattern[end] == '0') {
        for (++end; end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9' && digits <= kMaxDigits; ++end)
            digits = 10 * digits + (pattern[end] - '0');
        if (digits < 1 || digits > kMaxDigits) fail_pattern(pattern, "needs 1 to 9 digits");
    }
    if (end >= pattern.size() || pattern[end] != 'd') fail_pattern(pattern, "needs %d or %0Nd behind its per cent sign");
    at = end + 1;
    std::string number = std::to_string(frame);
    if (int(number.size()) < digits) number.insert(0, size_t(digits) - number.size(), '0');
    return number;
}

}  // namespace

bool SequenceOptions::is_sequence() const { return frames > 1 || path || accumulation || clamp || !frames_out.empty() || !flicker.empty(); }

shading::TemporalOptions SequenceOptions::temporal() const {
    shading::TemporalOptions options;
    options.accumulation = accumulation.value_or(Accumulation::Mean);
    options.weight = weight.value_or(options.weight);
    options.clamp = clamp.value_or(options.clamp);
    return options;
}

void declare_sequence_options(CommandLine& line, SequenceOptions& sequence) {
    line.group("Frames (docs/frames.md)");
    line.option("--frames", "N",
                "render N frames, 1 to " + std::to_string(kMaxFrames) +
                    " (default 1), and accumulate them: frame f takes samples f x spp "
                    "and on, the last frame's image is saved; counters are the first frame's, layers the last one's",
                [&](const std::string& text) { sequence.frames = int(parse_integer("--frames", text, 1, kMaxFrames)); });
    line.option("--camera-path", "orbit|dolly|FILE.json|gltf",
                "once around the target, half of the way to it, through the key frames of a file, or as the glTF's first animation of the "
                "camera moves it (default: the camera rests)",
                [&](const std::string& text) { sequence.path = parse_camera_path(text); });
    line.option("--accumulate", "mean|ema[:A]|reproject[:A]",
                "the mean of all samples (the default), a history that each frame moves towards itself by its weight A (" +
                    print(NumberRange{kLeastWeight, 1.0f}) + ", default " + print_number(shading::TemporalOptions{}.weight) +
                    "), or the same with the history following the surfaces",
                [&](const std::string& text) { parse_accumulate(text, sequence); });
    line.option("--history-clamp", "on|off",
                "of reproject: keep the history within what the pixel and its 8 neighbours show in the frame (default on)",
                [&](const std::string& text) {
                    sequence.clamp = parse_word("--history-clamp", text, {"on", "off"}) == 0;
                });
    line.option("--frames-out", "PATTERN", "write the accumulated image of every frame, too: frame-%04d.png becomes frame-0000.png ...",
                [&](const std::string& text) { sequence.frames_out = text; });
    line.option("--flicker", "FILE.exr",
                "the standard deviation over time of every value of the accumulated images of the last half of the frames",
                [&](const std::string& text) { sequence.flicker = text; });
}

CameraPathOption parse_camera_path(std::string_view text) {
    if (text == "orbit") return {CameraPathKind::Orbit, {}};
    if (text == "dolly") return {CameraPathKind::Dolly, {}};
    if (text == "gltf") return {CameraPathKind::Gltf, {}};
    // What looks like no file and is none was meant to be a word.
    if (text.find_first_of("/.") == text.npos && !std::filesystem::exists(text))
        throw UsageError(unknown_value("--camera-path", text, std::vector<std::string>{"orbit", "dolly", "gltf"}).what() +
                         std::string(", or the path of a .json file"));
    return {CameraPathKind::File, std::string(text)};
}

std::string print(const CameraPathOption& path) {
    switch (path.kind) {
        case CameraPathKind::Orbit: return "orbit";
        case CameraPathKind::Dolly: return "dolly";
        case CameraPathKind::Gltf: return "gltf";
        case CameraPathKind::File: break;
    }
    return path.file;
}

void parse_accumulate(std::string_view text, SequenceOptions& sequence) {
    const size_t colon = text.find(':');
    const std::string_view name = text.substr(0, colon);
    sequence.accumulation = parse_choice("--accumulate", name, {Accumulation::Mean, Accumulation::Ema, Accumulation::Reproject});
    if (colon == text.npos) return;
    if (*sequence.accumulation == Accumulation::Mean) throw UsageError("--accumulate: 'mean' takes no weight, all samples count alike");
    sequence.weight = parse_number("--accumulate", text.substr(colon + 1), {kLeastWeight, 1.0f});
}

std::string print_accumulate(const SequenceOptions& sequence) {
    const shading::TemporalOptions options = sequence.temporal();
    const std::string name(to_string(options.accumulation));
    return options.accumulation == Accumulation::Mean ? name : name + ":" + print_number(options.weight);
}

int first_flicker_frame(int frames) { return frames / 2; }

std::string frame_name(std::string_view pattern, int frame) {
    std::string name;
    int numbers = 0;
    for (size_t at = 0; at < pattern.size();) {
        if (pattern[at] != '%') {
            name += pattern[at++];
        } else if (at + 1 < pattern.size() && pattern[at + 1] == '%') {
            name += '%';
            at += 2;
        } else {
            name += number_at(pattern, at, frame);
            ++numbers;
        }
    }
    if (numbers != 1) fail_pattern(pattern, numbers == 0 ? "has no %d for the frame's number" : "has more than one number");
    return name;
}

void check(const SequenceOptions& sequence, int spp) {
    if (int64_t(sequence.frames) * spp > kMaxSequenceSamples)
        throw UsageError("--frames: " + std::to_string(sequence.frames) + " frames of " + std::to_string(spp) +
                         " samples are too many (allowed: 2^31 samples in all)");
    if (sequence.clamp && sequence.temporal().accumulation != Accumulation::Reproject)
        throw UsageError("--history-clamp is for --accumulate reproject alone");
    if (!sequence.frames_out.empty()) frame_name(sequence.frames_out, 0);
    if (!sequence.flicker.empty() && sequence.frames < kLeastFlickerFrames)
        throw UsageError("--flicker: the last half of " + std::to_string(sequence.frames) + " frames does not change (allowed: --frames " +
                         std::to_string(kLeastFlickerFrames) + " or more)");
}

}  // namespace rawtexel::cli
