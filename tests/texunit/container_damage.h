// Files to damage, and the damage: for the tests and the fuzz targets of the container readers.
#pragma once

#include "tests/texunit/container_writer.h"

#include <random>
#include <vector>

namespace rawtexel::texunit::test_files {

/// Small valid DDS and KTX2 files of every kind of texel, shape and supercompression.
std::vector<Bytes> seed_files();

/// Damages `bytes` in one to four places, more often in the header than behind it.
void damage(Bytes& bytes, std::mt19937_64& random);

}  // namespace rawtexel::texunit::test_files
