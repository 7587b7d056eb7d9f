#include "texunit/fetch_log.h"

namespace rawtexel::texunit {

FetchCounts& FetchCounts::operator+=(const FetchCounts& other) {
    lookups += other.lookups;
    taps += other.taps;
    texels_requested += other.texels_requested;
    for (size_t level = 0; level < level_texels.size(); ++level) level_texels[level] += other.level_texels[level];
    return *this;
}

}  // namespace rawtexel::texunit
