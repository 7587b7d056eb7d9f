#include "shading/tile_planes.h"

#include <algorithm>

namespace rawtexel::shading {

TilePlanes::TilePlanes(std::span<const Aov> aovs, bool coverage) {
    const auto asked = [&](Aov aov) { return std::find(aovs.begin(), aovs.end(), aov) != aovs.end(); };
    const auto place = [&](bool wanted, int planes) {
        const int first = count;
        count += wanted ? planes : 0;
        return wanted ? first : -1;
    };
    hits = place(coverage || asked(Aov::Depth) || asked(Aov::Normal) || asked(Aov::Albedo) || asked(Aov::Uv), 1);
    depth = place(asked(Aov::Depth), 1);
    normal = place(asked(Aov::Normal), 3);
    albedo = place(asked(Aov::Albedo), 3);
    uv = place(asked(Aov::Uv), 2);
    if (asked(Aov::Lod)) lod = first_sample_count++;
    if (asked(Aov::Material)) material = first_sample_count++;
}

}  // namespace rawtexel::shading
