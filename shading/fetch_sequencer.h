// Work that tiles finish in any order, handed on in the order of the tiles.
#pragma once

#include "texunit/fetch_stream.h"

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

namespace rawtexel::shading {

/// Tiles are numbered from 0 and must be begun in that order (FetchSequencer::next_tile), by however many threads. What the tile that is
/// due hands in goes on at once; other tiles' streams wait: all of them together in memory up to a limit, and beyond it with their threads.
class FetchSequencer {
  public:
    /// Called for one stream at a time, in the order of tiles and within a tile in the order handed in.
    using Consume = std::function<void(int64_t tile, const texunit::FetchStream& stream)>;
    explicit FetchSequencer(Consume consume) : consume_(std::move(consume)) {}

    /// The tile that the calling thread is to do.
    int64_t next_tile();
    /// Takes the stream's contents.
    void hand_in(int64_t tile, texunit::FetchStream& stream);
    void finish(int64_t tile);
    /// Lets all go that wait: some tile will never finish.
    void abandon();

  private:
    static constexpr size_t kMostWaitingBytes = size_t{128} << 20;

    struct Tile {
        std::vector<texunit::FetchStream> waiting;
        bool finished = false;
    };
    void consume_due();

    Consume consume_;
    std::mutex mutex_;
    std::condition_variable due_changed_;
    std::map<int64_t, Tile> tiles_;
    size_t waiting_bytes_ = 0;
    int64_t next_ = 0, due_ = 0;
    bool abandoned_ = false;
};

}  // namespace rawtexel::shading
