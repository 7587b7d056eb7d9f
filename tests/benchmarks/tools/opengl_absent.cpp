#include "tests/benchmarks/tools/peer_lookup.h"

namespace rawtexel::tools {

std::unique_ptr<PeerSampler> make_opengl_sampler(const Pyramid&, int) { return nullptr; }

}  // namespace rawtexel::tools
