// Who runs the tiles: TBB, or plain threads where the thread sanitizer must see everything.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace rawtexel::shading {

class Executor {
  public:
    virtual ~Executor() = default;
    virtual int threads() const = 0;
    /// Runs body(index, worker) for every index in [0, count), in any order; worker is in [0, threads()), one body at a time per worker.
    /// Returns when all are done. After an exception no new index starts, and the one of the smallest index that threw is rethrown here.
    virtual void parallel_for(int64_t count, const std::function<void(int64_t index, int worker)>& body) = 0;
};

/// The same without workers' numbers, as raster takes it; refers to `executor`.
std::function<void(int64_t count, const std::function<void(int64_t index)>& body)> parallel_for_of(Executor& executor);

enum class ExecutorKind { Tbb, Threads };

/// `threads` 0: all cores. The environment variable RAWTEXEL_EXECUTOR=threads is honoured by default_executor_kind().
std::unique_ptr<Executor> make_executor(ExecutorKind kind, int threads);
ExecutorKind default_executor_kind();

}  // namespace rawtexel::shading
