#include "shading/fetch_sequencer.h"

#include <utility>

namespace rawtexel::shading {

int64_t FetchSequencer::next_tile() {
    const std::lock_guard lock(mutex_);
    return next_++;
}

void FetchSequencer::hand_in(int64_t tile, texunit::FetchStream& stream) {
    std::unique_lock lock(mutex_);
    // The tile that is due was begun before all that wait, so it goes on, and those that wait become due or find room.
    const size_t bytes = stream.bytes();
    due_changed_.wait(lock, [&] { return tile == due_ || waiting_bytes_ + bytes <= kMostWaitingBytes || abandoned_; });
    if (abandoned_) return stream.clear();
    if (tile == due_) {
        consume_(tile, stream);
        return stream.clear();
    }
    waiting_bytes_ += bytes;
    tiles_[tile].waiting.push_back(std::exchange(stream, {}));
}

void FetchSequencer::finish(int64_t tile) {
    const std::lock_guard lock(mutex_);
    tiles_[tile].finished = true;
    if (tile == due_ && !abandoned_) consume_due();
}

void FetchSequencer::abandon() {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
    due_changed_.notify_all();
}

/// The tile that was due has finished: the next ones, as far as they have come.
void FetchSequencer::consume_due() {
    for (bool finished = true; finished;) {
        tiles_.erase(due_++);
        Tile& tile = tiles_[due_];
        for (const texunit::FetchStream& stream : tile.waiting) {
            waiting_bytes_ -= stream.bytes();
            consume_(due_, stream);
        }
        tile.waiting.clear();
        finished = tile.finished;
    }
    due_changed_.notify_all();
}

}  // namespace rawtexel::shading
