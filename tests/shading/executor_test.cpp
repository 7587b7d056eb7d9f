#include "shading/executor.h"

#include "tests/shading/executor_kinds.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace rawtexel::shading {
namespace {

struct Setup {
    ExecutorKind kind;
    int threads;
};

std::string name_of(const testing::TestParamInfo<Setup>& info) {
    return std::string(info.param.kind == ExecutorKind::Tbb ? "Tbb" : "Threads") + std::to_string(info.param.threads);
}

class ExecutorTest : public testing::TestWithParam<Setup> {
  protected:
    std::unique_ptr<Executor> executor_ = make_executor(GetParam().kind, GetParam().threads);
};

std::vector<Setup> setups() {
    std::vector<Setup> all;
    for (const ExecutorKind kind : executor_kinds()) {
        for (const int threads : {1, 2, 7}) all.push_back({kind, threads});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExecutorTest, testing::ValuesIn(setups()), name_of);

TEST_P(ExecutorTest, RunsEveryIndexOnce) {
    for (const int64_t count : {0, 1, 2, 1000}) {
        std::vector<std::atomic<int>> runs(static_cast<size_t>(count));
        executor_->parallel_for(count, [&](int64_t index, int) { ++runs[size_t(index)]; });
        for (int64_t i = 0; i < count; ++i) ASSERT_EQ(runs[size_t(i)], 1) << "index " << i << " of " << count;
    }
}

TEST_P(ExecutorTest, GivesEachWorkerOneBodyAtATime) {
    EXPECT_EQ(executor_->threads(), GetParam().threads);
    std::vector<std::atomic<int>> busy(static_cast<size_t>(GetParam().threads));
    std::atomic<int> collisions{0};
    executor_->parallel_for(2000, [&](int64_t, int worker) {
        ASSERT_GE(worker, 0);
        ASSERT_LT(worker, GetParam().threads);
        if (busy[size_t(worker)]++ != 0) ++collisions;
        std::this_thread::yield();
        --busy[size_t(worker)];
    });
    EXPECT_EQ(collisions, 0);
}

TEST_P(ExecutorTest, RethrowsTheSmallestIndexThatThrewAndStartsNoMore) {
    std::atomic<int64_t> started{0}, smallest{1 << 20};
    try {
        executor_->parallel_for(100000, [&](int64_t index, int) {
            ++started;
            if (index < 50) return;
            int64_t seen = smallest;
            while (index < seen && !smallest.compare_exchange_weak(seen, index)) {
            }
            throw std::runtime_error(std::to_string(index));
        });
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::stoll(error.what()), smallest);
    }
    EXPECT_LT(started, 50 + 4 * GetParam().threads + 1) << "indices started after one had thrown";
}

TEST_P(ExecutorTest, WorksAgainAfterAnException) {
    EXPECT_THROW(executor_->parallel_for(3, [](int64_t, int) { throw std::runtime_error("once"); }), std::runtime_error);
    std::atomic<int> runs{0};
    executor_->parallel_for(100, [&](int64_t, int) { ++runs; });
    EXPECT_EQ(runs, 100);
}

TEST_P(ExecutorTest, RunsOnSeveralThreadsAtOnce) {
    if (GetParam().threads < 2) GTEST_SKIP() << "one thread asked for";
    std::atomic<int> inside{0};
    std::atomic<bool> met{false};
    executor_->parallel_for(2, [&](int64_t, int) {
        ++inside;
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        while (!met && std::chrono::steady_clock::now() < deadline) {
            if (inside == 2) met = true;
            std::this_thread::yield();
        }
        --inside;
    });
    EXPECT_TRUE(met) << "two bodies were never under way together";
}

TEST_P(ExecutorTest, ServesRasterWithoutWorkerNumbers) {
    std::atomic<int64_t> sum{0};
    parallel_for_of (*executor_)(101, [&](int64_t index) { sum += index; });
    EXPECT_EQ(sum, 5050);
}

TEST(Executor, TakesAllCoresForZeroThreads) {
    EXPECT_EQ(make_executor(ExecutorKind::Threads, 0)->threads(), std::max(1, int(std::thread::hardware_concurrency())));
}

TEST(Executor, IsChosenByTheEnvironment) {
    ASSERT_EQ(setenv("RAWTEXEL_EXECUTOR", "threads", 1), 0);
    EXPECT_EQ(default_executor_kind(), ExecutorKind::Threads);
    ASSERT_EQ(unsetenv("RAWTEXEL_EXECUTOR"), 0);
    EXPECT_EQ(default_executor_kind(), ExecutorKind::Tbb);
}

}  // namespace
}  // namespace rawtexel::shading
