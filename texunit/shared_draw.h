// Lookups that share their random numbers, such as the maps of a material: all of them draw the same texel where their textures and
// coordinates agree, and correlated ones where they do not. Sharing is what makes filtering after shading right (Pharr, Wronski, Salvi and
// Fajardo 2024): with numbers of their own, the mean of a product of maps is the product of their means.
//
// What shared lookups draw from is one joint distribution over tuples of texels. enumerate_shared lists it: along every role of a number
// (level, probe, signs, x, y, z) the lookups' inverse distributions are step functions, and between two neighbouring steps of any of them
// all lookups keep their texels. The tuples' weights are the products of those intervals' lengths.
//
// Kernels with negative lobes draw twice (texunit/draw.h). Lookups of a set may have negative weights of different mass; the set draws the
// largest, and the others make up what they lack with texels of their positive weights, which come in again with the positive draw. So
// every lookup keeps its own mean, and a constant has no variance.
#pragma once

#include "texunit/draw.h"

#include <functional>

namespace rawtexel::texunit {

inline constexpr int kMostSharedLookups = 8;

/// A lookup of a flat texture or a layer of an array; or, where `solid` says where instead of `at`, of a volume, or of a cube map as
/// sample_cube_wave defines it. Those two are isotropic: their samplers have one probe and no ellipse (asserted). The coordinates have no
/// inactive lanes: those outside `mask` repeat an active one.
struct SharedLookup {
    const LevelTable* levels = nullptr;
    const SamplerState* sampler = nullptr;
    const WaveCoordinates* at = nullptr;
    const WaveCoordinates3* solid = nullptr;
    bool cube = false;                 ///< `solid` holds directions
    const WaveFloat* layer = nullptr;  ///< of an array, or which cube of one: rounded and bounded as by sample_wave. Null: the first
    int layers = 1;                    ///< layers of the array, or cubes
};

struct LookupSet {
    WaveMask mask = 0;  ///< lanes that look up, not 0
    int count = 0;
    SharedLookup lookup[kMostSharedLookups];
};

/// One tuple: the texel of each lookup of a set. The value of the whole is the sum over tuples of weight*S(texels).
struct SharedTap {
    TexelDraw draw[kMostSharedLookups];  ///< of the set's lookups; nothing beyond them
    WaveFloat weight;
    WaveMask lanes = 0;  ///< that weigh it; others hold anything that can be read
};
using UseTap = std::function<void(const SharedTap& tap)>;

/// One draw, of which flat lookups look at no z: a tuple of weight 1, or where kernels have negative lobes one of weight 1 + W and one of
/// weight -W. All estimators of a set are the same; AbsWeight gives the first lookup's factor as the weight.
void draw_shared(const LookupSet& set, const DrawNumbers& positive, const DrawNumbers& negative, const UseTap& use);

/// Every tuple with its weight; those of a lane sum to 1. An ellipse stands alone in its set (asserted).
void enumerate_shared(const LookupSet& set, const UseTap& use);

/// Whether enumerate_shared can list the set: ellipses with company cannot.
bool can_enumerate(const LookupSet& set);

}  // namespace rawtexel::texunit
