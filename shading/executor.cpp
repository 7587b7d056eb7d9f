#include "shading/executor.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdlib>
#include <exception>
#include <limits>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

namespace rawtexel::shading {
namespace {

using Body = std::function<void(int64_t index, int worker)>;

/// The indices of one parallel_for, handed out in ascending order. Every worker runs `work` once.
class IndexQueue {
  public:
    IndexQueue(int64_t count, const Body& body) : count_(count), body_(body) {}

    void work(int worker) {
        for (;;) {
            // Order does not matter for the index itself; what bodies share is ordered by the join that ends parallel_for.
            const int64_t index = next_.fetch_add(1, std::memory_order_relaxed);
            if (index >= count_ || failed_.load(std::memory_order_relaxed)) return;
            try {
                body_(index, worker);
            } catch (...) {
                keep(index, std::current_exception());
            }
        }
    }

    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

  private:
    void keep(int64_t index, std::exception_ptr error) {
        failed_.store(true, std::memory_order_relaxed);
        const std::lock_guard lock(mutex_);
        if (index >= failed_index_) return;
        failed_index_ = index;
        error_ = std::move(error);
    }

    const int64_t count_;
    const Body& body_;
    std::atomic<int64_t> next_{0};
    std::atomic<bool> failed_{false};
    std::mutex mutex_;
    int64_t failed_index_ = std::numeric_limits<int64_t>::max();
    std::exception_ptr error_;
};

/// Workers beyond the number of indices would find nothing.
int useful_workers(int threads, int64_t count) { return int(std::min<int64_t>(threads, count)); }

class TbbExecutor final : public Executor {
  public:
    explicit TbbExecutor(int threads)
        : threads_(threads), limit_(tbb::global_control::max_allowed_parallelism, size_t(threads)), arena_(threads) {}

    int threads() const override { return threads_; }

    void parallel_for(int64_t count, const Body& body) override {
        IndexQueue queue(count, body);
        const int workers = useful_workers(threads_, count);
        // One task per worker slot: TBB decides which thread serves a slot, and a slot is one thread's at a time.
        arena_.execute([&] {
            tbb::parallel_for(
                0, workers, [&](int worker) { queue.work(worker); }, tbb::simple_partitioner());
        });
        queue.rethrow();
    }

  private:
    int threads_;
    tbb::global_control limit_;
    tbb::task_arena arena_;
};

class ThreadExecutor final : public Executor {
  public:
    explicit ThreadExecutor(int threads) : threads_(threads) {}

    int threads() const override { return threads_; }

    void parallel_for(int64_t count, const Body& body) override {
        IndexQueue queue(count, body);
        {
            std::vector<std::jthread> others;
            for (int worker = 1; worker < useful_workers(threads_, count); ++worker)
                others.emplace_back([&queue, worker] { queue.work(worker); });
            queue.work(0);
        }
        queue.rethrow();
    }

  private:
    int threads_;
};

}  // namespace

std::function<void(int64_t, const std::function<void(int64_t)>&)> parallel_for_of(Executor& executor) {
    return [&executor](int64_t count, const std::function<void(int64_t)>& body) {
        executor.parallel_for(count, [&body](int64_t index, int) { body(index); });
    };
}

std::unique_ptr<Executor> make_executor(ExecutorKind kind, int threads) {
    assert(threads >= 0);
    if (threads == 0) threads = std::max(1, int(std::thread::hardware_concurrency()));
    if (kind == ExecutorKind::Threads) return std::make_unique<ThreadExecutor>(threads);
    return std::make_unique<TbbExecutor>(threads);
}

ExecutorKind default_executor_kind() {
    const char* choice = std::getenv("RAWTEXEL_EXECUTOR");
    return choice && std::string_view(choice) == "threads" ? ExecutorKind::Threads : ExecutorKind::Tbb;
}

}  // namespace rawtexel::shading
