// What options and scenarios may ask for at most.
#pragma once

namespace rawtexel::cli {

inline constexpr int kMaxImageExtent = 16384;  // pixels
inline constexpr int kMaxSamples = 1 << 20;    // per pixel
inline constexpr int kMaxLayer = 1 << 20;      // of an array of textures, counted from 0
inline constexpr int kMaxThreads = 1024, kMaxRepeats = 100000;
inline constexpr int kMaxFrames = 100000;                    // of a sequence
inline constexpr long long kMaxSequenceSamples = 1LL << 31;  // per pixel over all frames: numbers of samples have 32 bits

inline constexpr float kMaxLength = 1e15f;                     // metres: squares stay in single precision
inline constexpr float kMaxAngle = 36000.0f;                   // degrees: a hundred turns
inline constexpr float kMinFov = 0.01f, kMaxFov = 179.0f;      // degrees
inline constexpr float kMinZoom = 1e-6f, kMaxZoom = 1e6f;      // of an orbit
inline constexpr float kMaxRadiance = 1e15f, kMaxLux = 1e15f;  // of a background, of a light
inline constexpr float kMaxAmbient = 1e6f;
inline constexpr float kMaxExposure = 64.0f;  // EV, either way

}  // namespace rawtexel::cli
