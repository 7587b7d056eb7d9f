#include "texunit/fetch_log.h"

namespace rawtexel::texunit {

FetchCounts& FetchCounts::operator+=(const FetchCounts& other) {
    lookups += other.lookups;
    taps += other.taps;
    texels_requested += other.texels_requested;
    return *this;
}

}  // namespace rawtexel::texunit
