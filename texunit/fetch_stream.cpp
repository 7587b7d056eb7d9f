#include "texunit/fetch_stream.h"

#include <bit>

namespace rawtexel::texunit {

void FetchStream::clear() {
    pixels.clear();
    fetches.clear();
}

void FetchStreamRecorder::begin_wave(int x, int y, uint32_t sample) {
    x_ = x;
    y_ = y;
    sample_ = sample;
    for (std::vector<TexelFetch>& lane : lanes_) lane.clear();
}

void FetchStreamRecorder::end_wave(FetchStream& stream) {
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const std::vector<TexelFetch>& asked = lanes_[size_t(lane)];
        if (asked.empty()) continue;
        stream.pixels.push_back({uint16_t(x_ + lane % kWaveWidth), uint16_t(y_ + lane / kWaveWidth), sample_, uint32_t(asked.size())});
        stream.fetches.insert(stream.fetches.end(), asked.begin(), asked.end());
    }
}

void FetchStreamRecorder::begin_lookup(const Texture& texture, WaveMask) { texture_ = &texture; }

void FetchStreamRecorder::tap(const WaveTap& tap) {
    const LevelTable& table = texture_->levels();
    const StorageClass storage = texture_->texel_layout().storage;
    for (WaveMask rest = tap.lanes & ~tap.border; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        const int level = (*tap.level)[lane], slice = tap.slice == nullptr ? 0 : (*tap.slice)[lane];
        const int32_t texel = texel_index(table, storage, level, slice, (*tap.x)[lane], (*tap.y)[lane]);
        lanes_[size_t(lane)].emplace_back(place_, level, texel);
    }
}

}  // namespace rawtexel::texunit
