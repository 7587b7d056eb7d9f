// Streams of tiles reach their consumer in order, whoever finishes first and whatever goes wrong.
#include "shading/fetch_sequencer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace rawtexel::shading {
namespace {

TEST(FetchSequencer, HandsOnInTheOrderOfTilesWhoeverComesFirst) {
    constexpr int kTiles = 40, kStreams = 5;
    std::vector<std::pair<int64_t, uint32_t>> seen;
    FetchSequencer sequencer([&](int64_t tile, const texunit::FetchStream& stream) { seen.emplace_back(tile, stream.pixels[0].sample); });
    const auto work = [&] {
        for (int64_t tile; (tile = sequencer.next_tile()) < kTiles;) {
            for (uint32_t n = 0; n < kStreams; ++n) {
                texunit::FetchStream stream;
                // Some tiles hand in more than may wait.
                stream.pixels.assign(tile % 7 == 3 ? size_t{3} << 20 : 1, {0, 0, n, 0});
                if (tile % 3 == 0) std::this_thread::yield();
                sequencer.hand_in(tile, stream);
                EXPECT_TRUE(stream.empty());
            }
            sequencer.finish(tile);
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(seen.size(), size_t(kTiles * kStreams));
    for (size_t i = 0; i < seen.size(); ++i) {
        EXPECT_EQ(seen[i].first, int64_t(i) / kStreams);
        EXPECT_EQ(seen[i].second, i % kStreams);
    }
}

TEST(FetchSequencer, PassesOnWhatTheConsumerThrowsWhileOthersWait) {
    // A full disk, say, at the last stream of the tile that is due.
    FetchSequencer sequencer([](int64_t tile, const texunit::FetchStream&) {
        if (tile == 1) throw std::runtime_error("full");
    });
    const int64_t due = sequencer.next_tile(), next = sequencer.next_tile(), last = sequencer.next_tile();
    texunit::FetchStream stream;
    stream.pixels.assign(1, {});
    sequencer.hand_in(next, stream);
    std::thread waiter([&] {
        texunit::FetchStream large;
        large.pixels.assign(size_t{32} << 20, {});
        sequencer.hand_in(last, large);
    });
    try {
        sequencer.finish(due);
        ADD_FAILURE() << "nothing thrown";
    } catch (const std::runtime_error&) {
        sequencer.abandon();
    }
    waiter.join();
}

TEST(FetchSequencer, LetsEveryoneGoWhenATileFails) {
    FetchSequencer sequencer([](int64_t, const texunit::FetchStream&) {});
    const int64_t failing = sequencer.next_tile(), waiting = sequencer.next_tile();
    std::thread waiter([&] {
        for (int n = 0; n < 3; ++n) {
            texunit::FetchStream stream;
            stream.pixels.assign(size_t{6} << 20, {});
            sequencer.hand_in(waiting, stream);
        }
        sequencer.finish(waiting);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(failing, 0);
    sequencer.abandon();
    waiter.join();
}

}  // namespace
}  // namespace rawtexel::shading
