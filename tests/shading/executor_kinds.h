// The executors that tests run on. Debian's TBB is not instrumented: under the thread sanitizer it would report its own hand-overs as
// races.
#pragma once

#include "shading/executor.h"

#include <vector>

namespace rawtexel::shading {

inline std::vector<ExecutorKind> executor_kinds() {
#ifdef __SANITIZE_THREAD__
    return {ExecutorKind::Threads};
#else
    return {ExecutorKind::Tbb, ExecutorKind::Threads};
#endif
}

}  // namespace rawtexel::shading
