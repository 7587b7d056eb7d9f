// What operator new has handed out, for tests that bound memory. Counts the whole program.
#pragma once

#include <cstddef>

namespace rawtexel::texunit::test_files {

/// Bytes allocated and not freed.
size_t live_bytes();

/// The most that were live at once since the last `forget_peak`.
size_t peak_bytes();
void forget_peak();

}  // namespace rawtexel::texunit::test_files
