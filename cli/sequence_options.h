// The options that make a render a sequence of frames.
#pragma once

#include "cli/command_line.h"
#include "shading/temporal_options.h"

#include <optional>
#include <string>
#include <string_view>

namespace rawtexel::cli {

enum class CameraPathKind { Orbit, Dolly, File, Gltf };

struct CameraPathOption {
    CameraPathKind kind = CameraPathKind::Orbit;
    std::string file;  ///< of a File
    bool operator==(const CameraPathOption&) const = default;
};

struct SequenceOptions {
    int frames = 1;
    std::optional<CameraPathOption> path;               ///< unset: the camera rests
    std::optional<shading::Accumulation> accumulation;  ///< unset: the mean
    std::optional<float> weight;                        ///< of the newest frame; unset: TemporalOptions::weight
    std::optional<bool> clamp;                          ///< unset: on
    std::string frames_out;                             ///< a pattern of names; empty: no frame is written by itself
    std::string flicker;                                ///< the file of the deviations; empty: none

    /// True where any of them was given: the frames are then those of a sequence, be it of one.
    bool is_sequence() const;
    shading::TemporalOptions temporal() const;
};

void declare_sequence_options(CommandLine& line, SequenceOptions& sequence);

// The readers throw UsageError.
CameraPathOption parse_camera_path(std::string_view text);  // orbit dolly gltf FILE.json
std::string print(const CameraPathOption& path);
void parse_accumulate(std::string_view text, SequenceOptions& sequence);  // mean ema[:A] reproject[:A]
std::string print_accumulate(const SequenceOptions& sequence);

/// The first frame whose image counts for the flicker: that of the last half, an odd number rounded in its favour. Sequences of at least
/// kLeastFlickerFrames have one.
int first_flicker_frame(int frames);
inline constexpr int kLeastFlickerFrames = 3;

/// The name of frame `frame`: `pattern` with its one %d, or %0Nd for N digits, replaced by the number, and %% by a per cent sign.
/// Throws UsageError for other patterns.
std::string frame_name(std::string_view pattern, int frame);

/// Checks what single options cannot: that `spp` samples of every frame can be numbered, and options that mean nothing without others.
/// Throws UsageError.
void check(const SequenceOptions& sequence, int spp);

}  // namespace rawtexel::cli
