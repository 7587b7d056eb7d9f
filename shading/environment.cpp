#include "shading/environment.h"

#include "shading/environment_tables.h"
#include "shading/prefilter.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rawtexel::shading {
namespace {

/// RGB of an image of 3 or 4 channels; what is no light (NaN, infinite, negative) reads as 0.
Image clean_radiance(const Image& latlong) {
    Image clean(latlong.width, latlong.height, 3);
    for (int y = 0; y < latlong.height; ++y)
        for (int x = 0; x < latlong.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = latlong.pixel(x, y)[c];
                clean.pixel(x, y)[c] = std::isfinite(value) && value > 0.0f ? value : 0.0f;
            }
    return clean;
}

}  // namespace

float RoughnessScale::roughness_of(int level) const {
    if (level == 0) return 0.0f;
    if (level > kCosineLevel) return kFlatRoughness;
    const float t = float(level - 1) / float(kCosineLevel - 1);
    return (first * (1.0f + kBend) + t * kBend * (1.0f - first)) / ((1.0f + kBend) - t * (1.0f - first));
}

std::string_view to_string(EnvironmentReflections reflections) {
    switch (reflections) {
        case EnvironmentReflections::Prefiltered: return "prefiltered";
        case EnvironmentReflections::SplitSum: return "split-sum";
    }
    return "";
}

Environment::Environment(const Image& latlong, Executor& executor) {
    assert(latlong.channels >= 3 && latlong.width > 0 && latlong.height > 0);
    auto tables = std::make_shared<Tables>();
    const Image clean = clean_radiance(latlong);
    tables->width = clean.width;
    tables->height = clean.height;
    tables->latlong.assign(clean.values.begin(), clean.values.end());
    prefilter(clean, executor, *tables);
    tables_ = std::move(tables);
}

}  // namespace rawtexel::shading
